#include "benchmarks/suites/stability/subjects.h"

#include "benchmarks/suites/stability/cases.h"

namespace prelight::benchmarks::stability {

namespace {

constexpr const char* sumOfMagnitudes = "sum of the terms' magnitudes";
constexpr const char* sumRule =
    "n roundings of a sum of n products, in any order, fused or not (Higham 2002, 3.1)";
constexpr const char* itself = "the value itself";

std::vector<Subject> bases() {
  using enum SubjectKind;
  return {
      {"SH on the host",
       Basis,
       "the standard library's Legendre functions, extended precision",
       "greatest value of the band",
       "a recurrence that is stable in l, and l times the rounding of the direction's length, in double",
       {},
       runHostSh},
      {"CH on the host",
       Basis,
       "derivatives of Chebyshev polynomials by Gegenbauer's recurrence, extended precision; norms; there "
       "and back",
       "the greatest of 1 and the value",
       "order^2 roundings in double; there and back the square of the condition number",
       {},
       runCh},
      {"Haar on the host",
       Basis,
       "the sum over each wavelet's support, double",
       "sum of the texels' magnitudes under it over its side",
       "three roundings a level",
       {},
       runHaar},
      {"quincunx on the host",
       Basis,
       "there and back",
       "greatest value",
       "a few roundings a step in double",
       {},
       runQuincunx},
  };
}

std::vector<Subject> basesOnDevices() {
  using enum SubjectKind;
  return {
      {"SH",
       Basis,
       "SH on the host",
       "greatest value of the band",
       "carried as sums of two floats: a few roundings at every order",
       {"lab/kernels/sh_evaluate_kernels.cl:evaluateSh"},
       runShEvaluate},
      {"CH",
       Basis,
       "CH on the host",
       "greatest value of the band of SH",
       "carried as sums of two floats: a few roundings at every order",
       {"lab/kernels/sh_evaluate_kernels.cl:evaluateSh"},
       runChEvaluate},
      {"sums of SH and CH",
       Basis,
       "the same functions in double",
       "sum of the weights' magnitudes times the greatest value of the order",
       std::string(sumRule) + ", and a few roundings a band",
       {"lab/kernels/harmonic_sum_kernels.cl:sumHarmonics"},
       runHarmonicSums},
      {"SH rotation",
       Basis,
       "the same matrices in double",
       sumOfMagnitudes,
       sumRule,
       {"lab/kernels/light_kernels.cl:rotateBands"},
       runShRotation},
      {"sky to SH",
       Basis,
       "exact integrals over texels, double",
       "the sky's flux times the greatest value of the band",
       std::string(sumRule) + ", of 16 lanes, runs of 32 rows, and the rotation to the world's axes",
       {"lab/kernels/light_kernels.cl:skyMoments", "lab/kernels/light_kernels.cl:skyCoefficients",
        "lab/kernels/light_kernels.cl:rotateBands"},
       runSkyToSh},
      {"sky to Haar",
       Basis,
       "the same points of the sky in double",
       "greatest texel",
       std::string(sumRule) + ", and three roundings a level there and back",
       {"lab/kernels/light_kernels.cl:sampleCube", "lab/kernels/light_kernels.cl:haarLevel"},
       runSkyToHaar},
  };
}

std::vector<Subject> relighting() {
  using enum SubjectKind;
  return {
      {"relighting, dense",
       Kernel,
       "dot products in double",
       sumOfMagnitudes,
       sumRule,
       {"lab/kernels/dense_kernels.cl:relightDense"},
       runDense},
      {"relighting, two keys",
       Kernel,
       "dot products in double",
       sumOfMagnitudes,
       sumRule,
       {"lab/kernels/dense_kernels.cl:relightBetweenKeys"},
       runKeys},
      {"relighting, clusters",
       Kernel,
       "the same terms in double",
       sumOfMagnitudes,
       sumRule,
       {"lab/kernels/cluster_kernels.cl:relightClusters"},
       runClusters},
      {"relighting, Haar",
       Kernel,
       "sparse sums in double",
       sumOfMagnitudes,
       sumRule,
       {"relight/haar_kernels.cl:relightHaarRows", "relight/haar_kernels.cl:relightHaarColumns"},
       runHaarRows},
      {"relighting, glossy",
       Kernel,
       "matrices and lobes in double",
       "sum of the terms' magnitudes; of lobes at the greatest value of their band",
       std::string(sumRule) + "; of lobes a few roundings a band",
       {"relight/glossy_kernels.cl:lightMatrices", "relight/glossy_kernels.cl:shadeGlossy"},
       runGlossy},
      {"relighting, occluders",
       Kernel,
       "occluders/occluder_light.h in double",
       "greatest light of any vertex",
       "series for powers to 1e-6 of their exponent, which shadows and lobes magnify by up to 100",
       {"relight/occluder_kernels.cl:prepareOccluders", "relight/occluder_kernels.cl:relightOccluders"},
       runOccluders},
  };
}

std::vector<Subject> casting() {
  using enum SubjectKind;
  return {
      {"rays of receivers",
       Kernel,
       "receivers/sampling.h in double",
       "1: unit directions",
       "the cosine of a grazing ray, sqrt(1 - r^2), has half of the digits",
       {"cast/generate_kernels.cl:generateRays"},
       runGenerateRays},
      {"tracing",
       Kernel,
       "every triangle by Cramer's rule in double; hits off the plane of their triangle",
       "distance to the triangle's farthest corner",
       "a few roundings of Woop's test; docs/notes/robustness.md has the bounds of t, u and v",
       {"bvh/wide_kernels.cl:traceRays", "bvh/narrow_kernels.cl:traceRays",
        "bvh/nearer_kernels.cl:keepNearer", "bvh/wide_shadow_kernels.cl:traceShadows",
        "bvh/narrow_shadow_kernels.cl:traceShadows", "bvh/nearer_kernels.cl:joinShadows"},
       runTracing},
      {"projection",
       Kernel,
       "means in double",
       "mean magnitude of V - k, at the greatest value of the band",
       std::string(sumRule) + "; some roundings a band",
       {"project/project_kernels.cl:projectHits", "project/shell_kernels.cl:projectShells",
        "project/sector_kernels.cl:projectSectors"},
       runProjection},
      {"bounces",
       Kernel,
       "means in double",
       sumOfMagnitudes,
       sumRule,
       {"cast/transport_kernels.cl:gatherBounce", "cast/transport_kernels.cl:gatherGlossy"},
       runGatherBounce},
      {"stored senders",
       Kernel,
       "albedo and corners",
       "1",
       "ten bits a channel",
       {"cast/transport_kernels.cl:storeSenders"},
       runStoreSenders},
      {"texels of rays",
       Kernel,
       "texels in double, either one next to a border; decisions",
       "1",
       "eight bits of occlusion; decisions are right or wrong",
       {"project/texel_kernels.cl:codeTexels", "cast/inside_kernels.cl:markInside"},
       runTexels},
      {"voxels",
       Kernel,
       "the same sums in double",
       "greatest value of the band, or sum of the terms' magnitudes",
       std::string(sumRule) + "; sines next to the poles have half of the digits",
       {"cast/volume_kernels.cl:generateVolumeRays", "cast/volume_kernels.cl:projectVolume",
        "cast/volume_kernels.cl:gatherVolume"},
       runVolume},
  };
}

std::vector<Subject> followedRays() {
  using enum SubjectKind;
  return {
      {"rays by mirrors",
       Pipeline,
       "the mirrored direction in Schlick's colours, in double; albedo and corners",
       "sum of the shares, at the greatest value of the band; or the power of 2 that an albedo is a part of",
       std::string(sumRule) + "; some roundings a band of the mirrored direction; ten bits a channel",
       {"cast/specular_kernels.cl:listSpecular", "cast/specular_kernels.cl:startSpecular",
        "cast/specular_kernels.cl:followSpecular", "cast/specular_kernels.cl:projectSpecular",
        "cast/transport_kernels.cl:storeFollowed"},
       runSpecular},
      {"walks in bodies",
       Pipeline,
       "1: a body that absorbs nothing and is alike in every channel changes no weight; what its inside "
       "emits",
       itself,
       "some roundings a step, of steps that grow with the square of the body's optical depth",
       {"transport/walk_kernels.cl:stepWalks", "cast/specular_kernels.cl:beginSpecularWalks",
        "cast/specular_kernels.cl:endSpecularWalks", "integrate/walk_kernels.cl:beginWalks",
        "integrate/walk_kernels.cl:endWalks"},
       runWalks},
  };
}

std::vector<Subject> transport() {
  using enum SubjectKind;
  return {
      {"reflection",
       Kernel,
       "the formulas of docs/notes/reference.md in double",
       "the value; of the diffuse lobe, what it would be without the layer",
       "the half vector is off by a few roundings, which a lobe of width alpha magnifies by 4 / alpha",
       {"lab/kernels/bsdf_probe_kernels.cl:probeReflection",
        "lab/kernels/bsdf_probe_kernels.cl:probeScatter"},
       runBsdf},
      {"samples of the sky",
       Kernel,
       "intervals of the tables in double",
       "the density over the sine of the polar angle",
       "next to a pole the angle has no more digits than the direction",
       {"lab/kernels/bsdf_probe_kernels.cl:probeSky"},
       runSkySampling},
      {"direct light",
       Kernel,
       "inverse squares, Lambert's formula for triangles, double",
       itself,
       "a dozen roundings a light; sums of many lights in runs; small far lamps by their distance over their "
       "size",
       {"radiosity/direct_kernels.cl:aimAtLights", "radiosity/direct_kernels.cl:sumLights",
        "radiosity/incident_kernels.cl:sumIncident"},
       runDirectLight},
      {"photons",
       Pipeline,
       "directions of the sequence in double; sums over albedos' powers; counts that add up exactly",
       "power that was sent",
       "a few roundings a surface; powers are counted in whole numbers",
       {"photon/emit_kernels.cl:emitPhotons", "photon/scatter_kernels.cl:scatterPhotons",
        "photon/importance_kernels.cl:endUnimportant", "core/queue_kernels.cl:countMarks",
        "core/queue_kernels.cl:startRuns", "core/queue_kernels.cl:listMarked",
        "core/queue_kernels.cl:listFew", "core/queue_kernels.cl:moveListed",
        "photon/scatter_kernels.cl:sumTallies"},
       runPhotons},
      {"counts of power",
       Kernel,
       "sums of whole numbers",
       "1",
       "exact",
       {"photon/scatter_kernels.cl:sumTallies"},
       runTallies},
  };
}

std::vector<Subject> indirectLight() {
  using enum SubjectKind;
  return {
      {"density estimates",
       Kernel,
       "all photons in double over the part of the disc that lies on the surface",
       itself,
       std::string(sumRule) + " in eight lanes; areas by closed forms",
       {"photon/density_kernels.cl:estimateIrradiance", "photon/incident_kernels.cl:estimateIncident",
        "lab/kernels/grid_kernels.cl:estimateFromGrid", "photon/guide_kernels.cl:estimateGuides"},
       runDensity},
      {"final gathering",
       Pipeline,
       "albedo x irradiance, the same everywhere; a light of a power of two as often that of 1",
       itself,
       sumRule,
       {"gather/gather_kernels.cl:gatherRadiance", "gather/gather_kernels.cl:askLights",
        "gather/gather_kernels.cl:addArrivals", "gather/gather_kernels.cl:sumRadiance",
        "gather/incident_kernels.cl:sumIncident", "gather/record_kernels.cl:generateRecordRays",
        "gather/record_kernels.cl:storeDistances", "gather/record_kernels.cl:sumRecords",
        "gather/guided_kernels.cl:generateGuidedRays", "gather/guided_kernels.cl:sumGuided"},
       runGather},
      {"radiosity's solvers",
       Kernel,
       "H_i = D_i + a mean(D) / (1 - a) where all see all alike",
       itself,
       "the residual's tolerance and the rounding of a row, over 1 - albedo",
       {"radiosity/solve_kernels.cl:gatherRows", "radiosity/solve_kernels.cl:measureRows",
        "radiosity/solve_kernels.cl:reflectRows", "radiosity/solve_kernels.cl:accelerateRows",
        "radiosity/solve_kernels.cl:sumResiduals", "radiosity/solve_kernels.cl:rankRows",
        "radiosity/solve_kernels.cl:relaxGreatest", "radiosity/solve_kernels.cl:takeUnsendable",
        "radiosity/solve_kernels.cl:takeRest"},
       runSolver},
      {"radiosity",
       Pipeline,
       "a closed room that emits: pi L / (1 - albedo)",
       itself,
       "as the solvers'",
       {"radiosity/form_factor_kernels.cl:codeElements", "radiosity/form_factor_kernels.cl:judgePoints"},
       runRadiosity},
  };
}

std::vector<Subject> pictures() {
  using enum SubjectKind;
  return {
      {"paths",
       Pipeline,
       "a closed room that emits: the sum of the albedo's powers; a floor under lights, and a denoiser's "
       "guides of it",
       itself,
       "eight roundings a segment; of a light's probability, 2^-32",
       {"integrate/path_ends_kernels.cl:generatePaths", "integrate/path_kernels.cl:collectRadiance",
        "integrate/path_kernels.cl:sampleLights", "integrate/path_ends_kernels.cl:addArrivals",
        "integrate/path_kernels.cl:scatterPaths", "integrate/path_ends_kernels.cl:averageSamples",
        "integrate/guide_kernels.cl:followGuides", "integrate/guide_kernels.cl:averageGuides",
        "integrate/path_ends_kernels.cl:averageParts", "integrate/culled_kernels.cl:listCulled",
        "integrate/culled_kernels.cl:keepBeyond", "integrate/caustic_path_kernels.cl:addPhotonLight",
        "integrate/caustic_path_kernels.cl:averageBlurs"},
       runPaths},
      {"means of samples",
       Kernel,
       "sums in double",
       itself,
       "compensated sums",
       {"integrate/path_ends_kernels.cl:averageSamples"},
       runAverages},
      {"pictures",
       Pipeline,
       "a light in a hollow sphere: a I / (pi (1 - a))",
       itself,
       "noise of few samples, and the sphere's facets",
       {"integrate/virtual_kernels.cl:makeVirtualLights", "integrate/virtual_kernels.cl:sampleVirtualLight",
        "integrate/virtual_kernels.cl:castFromVirtualLights", "integrate/cached_path_kernels.cl:followPaths"},
       runPictures},
  };
}

std::vector<Subject> keeping() {
  using enum SubjectKind;
  return {
      {"halves and pictures",
       Kernel,
       "the value; sums in double of up to 10^9 passes",
       itself,
       "half of a half's last digit; sums are double",
       {},
       runStorage},
      {"packed directions",
       Kernel,
       "the direction",
       "1",
       "16 bits a coordinate",
       {"lab/kernels/direction_probe_kernels.cl:probeDirections"},
       runPacked},
      {"copies and layouts",
       Kernel,
       "bits",
       "1",
       "exact",
       {"lab/kernels/light_kernels.cl:copyLanes", "core/layout_probe_kernels.cl:probeLayout"},
       runCopies},
      {"vertex fit",
       Kernel,
       "a linear function",
       "its size",
       "conjugate gradients stop at a residual of 1e-6, all of which one of n values may hold; a condition "
       "number of ten",
       {},
       runFit},
      {"refusals",
       Kernel,
       "NaN, infinity and negative light are refused, what is right is not",
       "1",
       "decisions are right or wrong",
       {},
       runRefusals},
      {"bakes",
       Pipeline,
       "closed forms of an open floor, a closed room, walls that emit",
       "1, or the value",
       "roundings; walls that emit: noise of few rays, and ten bits of albedo a bounce",
       {"cast/light_kernels.cl:generateLightRays", "cast/light_kernels.cl:sumLightRays",
        "cast/light_kernels.cl:addEmitterHits", "project/occluder_kernels.cl:aggregateOccluders"},
       runBakes},
      {"whole scenes",
       Pipeline,
       "nothing but that all is finite, AO in [0, 1], normals of length 1",
       "1",
       "roundings",
       {"project/occluder_way_kernels.cl:listMirrored", "project/occluder_way_kernels.cl:numberMirrored",
        "project/occluder_way_kernels.cl:listGlass", "project/occluder_way_kernels.cl:startGlass",
        "project/occluder_way_kernels.cl:followGlass"},
       runWholeScenes},
  };
}

}  // namespace

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> list = [] {
    std::vector<Subject> all;
    for (const auto& part : {bases(), basesOnDevices(), relighting(), casting(), followedRays(), transport(),
                             indirectLight(), pictures(), keeping()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return list;
}

}  // namespace prelight::benchmarks::stability
