export {
  Relighter, SkyLight, projectedSky, withoutItsSun, smoothingOf, smoothedBy, turnedAboutY, turnedBy, evaluateSh, chBasisOf, momentsOfLight,
  lampThrough, openTowards, decompressedRows,
};
