// Vertices side by side. Arrays with one number per vertex are stored in tiles of 16 vertices, [tile][row][lane], where
// a row is one number (a coefficient of a channel) of all 16: a work-item streams through its tile without a gap, and
// no sum runs across lanes. On a CPU a work-item takes a whole tile as float16; on a GPU it takes one vertex, and
// neighbours read neighbouring addresses.
//
// Options: PRELIGHT_WIDE_LANES  1: one work-item per tile
//          PRELIGHT_STORAGE     0: float, 1: IEEE half, 2: unsigned byte
//          PRELIGHT_ADD         1: colours are added to those that are there
#ifndef PRELIGHT_RELIGHT_LANE_FUNCS_CL
#define PRELIGHT_RELIGHT_LANE_FUNCS_CL

#define PRELIGHT_TILE 16

#ifndef PRELIGHT_STORAGE
#define PRELIGHT_STORAGE 0
#endif

#if PRELIGHT_STORAGE == 0
typedef float Stored;
#elif PRELIGHT_STORAGE == 1
typedef short Stored;
#else
typedef uchar Stored;
#endif

#ifdef PRELIGHT_WIDE_LANES
typedef float16 Lanes;
typedef short16 ShortLanes;
#define AS_LANES as_float16
#define CONVERT_LANES convert_float16
#define CONVERT_INT_LANES convert_int16
#define LOAD_ROW(pointer) vload16(0, pointer)
#define PRELIGHT_VERTICES_AN_ITEM PRELIGHT_TILE
#else
typedef float Lanes;
typedef short ShortLanes;
#define AS_LANES as_float
#define CONVERT_LANES convert_float
#define CONVERT_INT_LANES convert_int
#define LOAD_ROW(pointer) (*(pointer))
#define PRELIGHT_VERTICES_AN_ITEM 1
#endif

// Returns the index of the first number of a work-item's vertices in an array of `rows` rows per tile.
size_t firstOfItem(size_t item, size_t rows) {
#ifdef PRELIGHT_WIDE_LANES
  return item * rows * PRELIGHT_TILE;
#else
  return item / PRELIGHT_TILE * rows * PRELIGHT_TILE + item % PRELIGHT_TILE;
#endif
}

// Converts halves by their bits: shifting the sign-extended number puts sign, exponent and mantissa where a float has
// them, and a multiplication corrects the bias, for denormals too. Takes finite halves. (vload_half would do, but PoCL
// 3.1 converts bit by bit, one number at a time.)
Lanes __attribute__((always_inline)) lanesOfHalves(ShortLanes halves) {
  return AS_LANES((CONVERT_INT_LANES(halves) << 13) & (int)0x8fffe000) * 0x1p112f;
}

// Loads a row of stored numbers; `row` points at the item's first.
Lanes __attribute__((always_inline)) loadStored(__global const Stored* row) {
#if PRELIGHT_STORAGE == 0
  return LOAD_ROW(row);
#elif PRELIGHT_STORAGE == 1
  return lanesOfHalves(LOAD_ROW(row));
#else
  return CONVERT_LANES(LOAD_ROW(row));
#endif
}

#ifdef PRELIGHT_ADD
#define PUT_COLOR(place, value) ((place) += (value))
#else
#define PUT_COLOR(place, value) ((place) = (value))
#endif

// Writes one colour per vertex of the item: radiance [vertex][3].
void __attribute__((always_inline))
storeColors(Lanes red, Lanes green, Lanes blue, size_t item, uint vertexCount, __global float* radiance) {
#ifdef PRELIGHT_WIDE_LANES
  float colors[3][PRELIGHT_TILE];
  vstore16(red, 0, colors[0]);
  vstore16(green, 0, colors[1]);
  vstore16(blue, 0, colors[2]);
  const size_t first = item * PRELIGHT_TILE;
  const size_t count = min((size_t)PRELIGHT_TILE, vertexCount - first);
  for (size_t lane = 0; lane < count; ++lane)
    for (int c = 0; c < 3; ++c) PUT_COLOR(radiance[3 * (first + lane) + c], colors[c][lane]);
#else
  PUT_COLOR(radiance[3 * item], red);
  PUT_COLOR(radiance[3 * item + 1], green);
  PUT_COLOR(radiance[3 * item + 2], blue);
#endif
}

#endif
