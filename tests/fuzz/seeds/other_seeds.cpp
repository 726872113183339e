#include <OpenImageIO/imageio.h>
#include <avif/avif.h>
#include <zstd.h>

#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "base/kept_work.h"
#include "base/state_log.h"
#include "base/work_parts.h"
#include "device/program_cache.h"
#include "fuzz/seeds/seeds.h"
#include "fuzz/state_format.h"
#include "images/ktx2_files.h"
#include "images/picture_codecs.h"
#include "prelight/picture.h"
#include "scene/codecs/merl_brdf.h"
#include "support/compressed_files.h"
#include "support/gltf_files.h"

namespace prelight::fuzz {

namespace {

Seed fileBytes(const std::filesystem::path& path) { return bytesOf(test::readBytes(path)); }

/// Stream of meshopt behind the layout that the target reads.
Seed withLayout(unsigned mode, unsigned filter, unsigned stride, std::size_t count, Seed stream) {
  const Seed layout = {static_cast<std::uint8_t>(mode),
                       static_cast<std::uint8_t>(filter),
                       static_cast<std::uint8_t>(stride),
                       static_cast<std::uint8_t>(count - 1),
                       0,
                       0};
  stream.insert(stream.begin(), layout.begin(), layout.end());
  return stream;
}

/// The compressed stream of a document with Draco.
Seed dracoStream(const test::DracoEncoding& encoding) {
  const GltfDocument document = test::withDraco(test::triangleDocument(), encoding);
  const auto view =
      document.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["bufferView"]
          .get<std::size_t>();
  const auto& json = document.json["bufferViews"][view];
  const auto first = document.bin.begin() + json.value("byteOffset", std::ptrdiff_t{0});
  return {first, first + json["byteLength"].get<std::ptrdiff_t>()};
}

}  // namespace

void addStreamSeeds(Seeds& seeds) {
  std::vector<std::uint8_t> numbers(16 * 20);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<std::uint8_t>(i * i / 7);
  const std::vector<std::uint32_t> indices = {0, 1, 2, 2, 1, 3, 3, 1, 4, 5, 4, 1};
  for (unsigned filter = 0; filter < 5; ++filter) {
    const std::size_t stride = filter == 0 || filter == 3 ? 16 : 8;
    const unsigned stored = filter == 0 || filter == 3 ? 3 : 1;
    seeds["meshopt/attributes_" + std::to_string(filter)] =
        withLayout(0, filter, stored, 20, test::meshoptAttributes(numbers.data(), 20, stride));
  }
  // Version 1 (KHR_meshopt_compression): 16 elements of 4 bytes, whose deltas are stored as they are.
  Seed version1 = {0xa1, 0xff};
  version1.insert(version1.end(), 64, 1);
  version1.insert(version1.end(), 19, 0);
  version1.insert(version1.end(), {1, 2, 3, 4, 0});
  seeds["meshopt/version1"] = withLayout(0, 0, 0, 16, version1);
  seeds["meshopt/triangles"] = withLayout(1, 0, 1, 4, test::meshoptTriangles(indices));
  seeds["meshopt/indices"] = withLayout(2, 0, 0, 12, test::meshoptSequence(indices));
  seeds["draco/edgebreaker"] = dracoStream({true, 11, 8});
  seeds["draco/sequential"] = dracoStream({false, 11, 8});
  seeds["draco/floats"] = dracoStream({false, 0, 0});
}

namespace {

Seed avif() {
  avifImage* image = avifImageCreate(8, 8, 8, AVIF_PIXEL_FORMAT_YUV444);
  std::vector<std::uint8_t> rgba(8 * 8 * 4, 90);
  avifRGBImage rgb{};
  avifRGBImageSetDefaults(&rgb, image);
  rgb.pixels = rgba.data();
  rgb.rowBytes = 8 * 4;
  avifImageRGBToYUV(image, &rgb);
  avifEncoder* encoder = avifEncoderCreate();
  encoder->speed = AVIF_SPEED_FASTEST;
  avifRWData data = AVIF_DATA_EMPTY;
  avifEncoderWrite(encoder, image, &data);
  Seed bytes(data.data, data.data + data.size);
  avifRWDataFree(&data);
  avifEncoderDestroy(encoder);
  avifImageDestroy(image);
  return bytes;
}

/// One block of UASTC of each of the 19 modes, by the codes of the Khronos Data Format; further bits vary.
Seed uastcBlocks() {
  constexpr std::pair<unsigned, unsigned> codes[] = {{0x1, 4}, {0x35, 6}, {0x1D, 5}, {0x3, 5},  {0x13, 5},
                                                     {0xB, 5}, {0x1B, 5}, {0x7, 5},  {0x17, 5}, {0xF, 5},
                                                     {0x2, 3}, {0x0, 2},  {0x6, 3},  {0x1F, 5}, {0xD, 5},
                                                     {0x5, 7}, {0x15, 6}, {0x25, 6}, {0x9, 4}};
  Seed blocks;
  unsigned spice = 1;
  for (const auto& [code, bits] : codes) {
    test::BitWriter block;
    block.add(code, bits);
    for (unsigned i = bits; i < 128; ++i) block.add((spice = spice * 1103515245u + 12345u) >> 30 & 1u, 1);
    const Seed bytes = block.bytes();
    blocks.insert(blocks.end(), bytes.begin(), bytes.end());
  }
  return blocks;
}

/// The file that OpenImageIO writes for its extension.
Seed writtenAs(const std::filesystem::path& path, const Picture& picture) {
  const auto output = OIIO::ImageOutput::create(path.string());
  const OIIO::ImageSpec spec(picture.width, picture.height, 3, OIIO::TypeDesc::FLOAT);
  if (!output || !output->open(path.string(), spec) ||
      !output->write_image(OIIO::TypeDesc::FLOAT, picture.pixels.data()) || !output->close())
    throw std::runtime_error(path.string() + ": cannot be written");
  return fileBytes(path);
}

void addKtx2(Seeds& seeds) {
  test::Ktx2Parts plain;
  plain.format = 37;
  plain.width = plain.height = 2;
  plain.model = 1;
  plain.channels = {0, 1, 2, 15};
  plain.level.assign(16, 77);
  seeds["ktx2/plain"] = test::ktx2File(plain);
  test::Ktx2Parts packed = plain;
  packed.compression = 2;
  packed.levelBytes = plain.level.size();
  packed.level.resize(ZSTD_compressBound(plain.level.size()));
  packed.level.resize(
      ZSTD_compress(packed.level.data(), packed.level.size(), plain.level.data(), plain.level.size(), 3));
  seeds["ktx2/zstandard"] = test::ktx2File(packed);
  test::Ktx2Parts uastc;
  uastc.width = 4 * 19;
  uastc.level = uastcBlocks();
  seeds["ktx2/uastc"] = test::ktx2File(uastc);
}

}  // namespace

void addPictureSeeds(Seeds& seeds) {
  addKtx2(seeds);
  Image image{"", 5, 4, {}};
  for (std::uint8_t i = 0; i < 80; ++i) image.rgba.push_back(static_cast<std::uint8_t>(3 * i));
  seeds["picture/rgb.png"] = encodePng(image);
  seeds["picture/rgba.png"] = encodePng(image, PngChannels::Rgba);
  seeds["picture/avif.avif"] = avif();
  seeds["picture/ktx2.ktx2"] = seeds["ktx2/plain"];
  const test::TemporaryFolder folder;
  Picture picture{8, 4, std::vector<glm::vec3>(32, {0.5f, 1.0f, 0.25f})};
  picture.pixels[9] = {50.0f, 40.0f, 30.0f};
  writePicture(folder / "sky.exr", picture);
  seeds["sky/sky.exr"] = fileBytes(folder / "sky.exr");
  seeds["sky/sky.hdr"] = writtenAs(folder / "sky.hdr", picture);
  seeds["picture/jpeg.jpg"] = writtenAs(folder / "picture.jpg", picture);
  seeds["picture/webp.webp"] = writtenAs(folder / "picture.webp", picture);
  std::vector<PictureChannel> layers = {{"sh.l0m0.R", std::vector<float>(32, 1.0f)},
                                        {"walls.right", std::vector<float>(32, 2.0f)}};
  writePicture(folder / "map.exr", picture, layers);
  seeds["exr/layers.exr"] = fileBytes(folder / "map.exr");
  seeds["exr/plain.exr"] = seeds["sky/sky.exr"];
}

void addTextSeeds(Seeds& seeds) {
  seeds["ies/type_c.ies"] = bytesOf(
      "IESNA:LM-63-2002\n[TEST] x\n[MORE] y\nTILT=NONE\n1 1000 1.5 3 2 1 2 0.1 0.2 0.3\n1 1 100\n0 45 90\n0 "
      "90\n10 8 6\n5 4 3\n");
  seeds["ies/tilt.ies"] =
      bytesOf("IESNA91\nTILT=INCLUDE\n1\n3\n0 45 90\n1 .9 .8\n1 -1 1 2 1 1 1 0 0 0\n1 1 1\n0 90\n0\n8 4\n");
  seeds["ies/type_a.ies"] = bytesOf(
      "IES:LM-63-2019\nTILT=NONE\n1 -1 1 3 3 3 2 0 0 0\n1 1 1\n-90 0 90\n-90 0 90\n1 2 3\n4 5 6\n7 8 9\n");
  seeds["ies/type_b.ies"] = bytesOf("TILT=NONE\n1,-1,1,3,2,2,2,0,0,0\n1,1,1\n-90,0,90\n0,90\n1,2,3\n4,5,6\n");
  const char* options[] = {
      "light\npoint:1,2,3:4,5,6:radius=0.1",
      "light\ndirectional:0,-1,0:1,1,1:angle=0.5",
      "light\nspot:0,2,0:0,-1,0:10,30:5,5,5:radius=0.2",
      "light\narea:sphere:0,1,0:0.5:3,3,3:power",
      "light\narea:disk:0,1,0:0,-1,0:0.5:3,3,3:two-sided:exitance",
      "light\narea:quad:0,1,0:0,-1,0:1,2:3,3,3:turn=9",
      "light\narea:polygon:0,0,0:1,0,0:0,1,0:3,3,3",
      "group\nlamps=1,0.5,0.25",
      "part\nreflected=0.5",
      "part\nall=2",
      "compress\ncpca:64:8:byte",
      "compress\nvq:256",
      "compress\npca:4:float",
      "compress\nband8",
      "pattern\nLamp 12\nLa?p*",
      "pattern\n1,2.5,-3e2",
      "arguments\n--ao\n--sh\n4\n--bounces\n2\n--rays\n64\n--max-memory\n2G\n--seed\n7\n--compress\nauto:"
      "cpca:8:2",
      "arguments\n--haar\n8\n--haar-error\n0.2\n--glossy\n3\n--vo\n--occluders\nauto:4\n--error\n0.1",
      "arguments\n--lightmap\n--texel-size\n0.1\n--encode\nsh-2,ahd\n--photons\n100\n--caustics\n--denoise",
      "arguments\n--light-group\nlamps=L*,B\n--near\n0.1\n--far\n2\n--sh\n3\n--texels\n64\n--relief",
      "arguments\n--volume\n16\n--sh\n3\n--horizons\n8\n--thickness\n--cones\n--radiosity\n--"
      "solver\njacobi\n--time\n3",
      "arguments\n--at\n0.5\n--animation\nwalk\n--move\nBall:1,2,3:30\n--object\nb.glb:1,2,3:30:2\n--"
      "size\n64x32\n--env\npreetham:3:35",
      "arguments\n--scale\n0.001\n--brdf\nred=a.binary\n--scene\n0\n--variant\na\n--refine\n0.01\n--refine-"
      "vertices\n99\n--light\npoint:0,0,0:1,1,1"};
  std::size_t number = 0;
  for (const char* text : options) seeds["options/" + std::to_string(number++)] = bytesOf(text);
  seeds["uri/base64"] = bytesOf("data:application/octet-stream;charset=x;base64,AAEC/w==");
  seeds["uri/percent"] = bytesOf("data:text/plain,a%20b%zz%");
  seeds["uri/file"] = bytesOf("HTTP+x://a/../b%2Fc.png");
  Seed merl(merlHeaderBytes);
  const std::int32_t sizes[3] = {90, 90, 180};
  std::memcpy(merl.data(), sizes, sizeof sizes);
  for (const double value : {1.5, 0.0, -1.0, 300.25}) {
    merl.resize(merl.size() + sizeof value);
    std::memcpy(merl.data() + merl.size() - sizeof value, &value, sizeof value);
  }
  seeds["merl/begin"] = merl;
  const std::string payload = "compiled", key(64, '0');
  seeds["kernels/entry"] = bytesOf("PRELIGHT-KERNEL-1 " + key + " 8 " + sha256(payload) + "\n" + payload);
}

void addStateSeeds(Seeds& seeds) {
  const test::TemporaryFolder folder;
  for (const bool interrupt : {true, false}) {
    const std::filesystem::path path = folder / (interrupt ? "interrupted" : "done");
    {
      WorkKeeper keeper(StateLog(path, fuzzedKind, fuzzedKey()), 0.0);
      doKeptWork(keeper, interrupt);
    }
    Seed bytes = fileBytes(path);
    std::vector<std::uint8_t> repaired = bytes;
    seeds["state/" + path.filename().string()] = bytes;
    repaired.resize(repairState(repaired));
    seeds["state/" + path.filename().string() + "_repaired"] = repaired;
  }
}

void addPartSeeds(Seeds& seeds) {
  const test::TemporaryFolder folder;
  for (const std::uint32_t slices : {1U, 2U}) {
    const std::filesystem::path path = folder / ("1_of_" + std::to_string(slices));
    {
      WorkKeeper keeper(StateLog(folder / "out.state", fuzzedKind, fuzzedKey()), 0.0, true);
      WorkSlice slice(path, fuzzedKind, fuzzedKey(), {1, slices}, {"bake", "room.glb", "--ao"});
      keeper.divide(&slice);
      try {
        (void)doDividedWork(keeper);
      } catch (const StageEnd&) {
        // A slice ends with its stage.
      }
    }
    seeds["part/" + path.filename().string()] = fileBytes(path);
  }
}

}  // namespace prelight::fuzz
