export {
  Relighter, BakedFile, SkyLight, projectedSky, withoutItsLamps, smoothingOf, smoothedBy, turnedAboutY, turnedBy, evaluateSh, chBasisOf, momentsOfLight,
  lampThrough, openTowards, decompressedRows, withLampsOfSky,
};
