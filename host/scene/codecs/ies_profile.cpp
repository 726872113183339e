#include "scene/codecs/ies_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "base/magnitudes.h"
#include "prelight/error.h"

namespace prelight {

namespace {

constexpr const char* exportAgain = "get the profile from the lamp's maker again";
constexpr std::size_t mostIntensities = std::size_t{1} << 20;
constexpr double whole = 360.0, half = 180.0, quarter = 90.0;  ///< degrees
constexpr double leastStep = 1e-4;                             ///< degrees; kernels can resolve such angles
constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";

/// Reads the lines of a profile and the numbers that follow them.
class IesReader {
 public:
  IesReader(std::string_view text, const std::string& where) : text_(text), where_(where) {
    if (text_.starts_with(byteOrderMark)) text_.remove_prefix(byteOrderMark.size());
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: line {}", where_, lineNumber()), what, exportAgain);
  }

  bool atEnd() const { return at_ >= text_.size(); }

  std::string_view line() {
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    std::string_view found = text_.substr(at_, end - at_);
    at_ = std::min(end + (text_.substr(end, 2) == "\r\n" ? 2 : 1), text_.size());
    while (!found.empty() && isSpace(found.back())) found.remove_suffix(1);
    while (!found.empty() && isSpace(found.front())) found.remove_prefix(1);
    return found;
  }

  double number(const char* what) {
    while (at_ < text_.size() && (isSpace(text_[at_]) || text_[at_] == ',' || text_[at_] == '+')) ++at_;
    double value = 0.0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error == std::errc::invalid_argument) {
      const std::string_view rest = text_.substr(at_, 12);
      fail(atEnd()
               ? fmt::format("the file ends, expected {}", what)
               : fmt::format("expected {}, got \"{}\"", what, rest.substr(0, rest.find_first_of("\r\n"))));
    }
    if (error != std::errc{} || !std::isfinite(value)) fail(fmt::format("{} is not a finite number", what));
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  double within(const char* what, double least, double most) {
    const double value = number(what);
    if (!(value >= least && value <= most))
      fail(fmt::format("{} is {:g}, expected {:g} to {:g}", what, value, least, most));
    return value;
  }

  /// Reads a number of values that follow; the file must have at least two bytes for each.
  std::size_t count(const char* what, std::size_t least) {
    const double value = number(what);
    const double most = static_cast<double>(roomForNumbers());
    if (!(value >= static_cast<double>(least) && value <= most && value == std::floor(value)))
      fail(fmt::format("{} is {:g}, expected a whole number from {} that the file has room for", what, value,
                       least));
    return static_cast<std::size_t>(value);
  }

  std::size_t roomForNumbers() const { return (text_.size() - at_) / 2 + 1; }

 private:
  static bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
  }

  /// Returns the number of the line that is read next. Lines end with LF, CR or both.
  std::size_t lineNumber() const {
    std::size_t number = 1;
    for (std::size_t i = 0; i < at_; ++i)
      if (text_[i] == '\n' || (text_[i] == '\r' && text_.substr(i + 1, 1) != "\n")) ++number;
    return number;
  }

  std::string_view text_;
  const std::string& where_;
  std::size_t at_ = 0;
};

/// The angles of a file, in degrees, and the intensities at them.
struct IesGrid {
  std::vector<double> vertical, horizontal;
  std::vector<double> values;  ///< [horizontal][vertical]

  double value(std::size_t h, std::size_t v) const { return values[h * vertical.size() + v]; }
};

std::vector<double> readAngles(IesReader& in, std::size_t count, const char* what, double least,
                               double most) {
  std::vector<double> angles;
  for (std::size_t i = 0; i < count; ++i) {
    angles.push_back(in.within(what, least, most));
    if (i > 0 && !(angles[i] - angles[i - 1] >= leastStep))
      in.fail(
          fmt::format("{} {:.10g} comes after {:.10g}, expected ascending ones, {:g} degrees apart at least",
                      what, angles[i], angles[i - 1], leastStep));
  }
  return angles;
}

/// Returns true when a first line names a version of 1995 or later.
bool isLate(std::string_view first) {
  constexpr std::string_view standard = "LM-63-";
  const std::size_t at = first.find(standard);
  if (at == std::string_view::npos) return false;
  const std::string_view rest = first.substr(at + standard.size());
  int year = 1900;
  std::from_chars(rest.data(), rest.data() + rest.size(), year);
  if (year >= 0 && year < 100) year += year < 86 ? 2000 : 1900;
  return year >= 1995;
}

/// Reads up to TILT=. Returns true when a profile was written before 1995: its second factor is then that of
/// ballast and lamp, while later profiles store other values there.
bool skipToTilt(IesReader& in) {
  const std::string_view first = in.line();
  const bool late = isLate(first);
  std::string_view line = first;
  while (!line.starts_with("TILT=")) {
    if (in.atEnd()) in.fail("expected a line that begins with TILT=: this is no photometric profile (LM-63)");
    line = in.line();
  }
  if (line.substr(5) == "INCLUDE") {
    in.number("the lamp's position in its housing");
    const std::size_t angles = in.count("the number of tilts", 0);
    for (std::size_t i = 0; i < 2 * angles; ++i) in.number("a tilt or its factor");
  }
  return !late;
}

void readValues(IesReader& in, double scale, IesGrid& grid) {
  const std::size_t count = grid.horizontal.size() * grid.vertical.size();
  grid.values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double value = scale * std::max(in.number("an intensity"), 0.0);
    if (!(value <= largestInput))
      in.fail(fmt::format("an intensity is {:g} cd, expected at most {:g}", value, largestInput));
    grid.values.push_back(value);
  }
}

/// Adds the columns mirrored about the last one.
void mirrorAtLast(IesGrid& grid) {
  const std::size_t rows = grid.vertical.size();
  const double last = grid.horizontal.back();
  for (std::size_t h = grid.horizontal.size() - 1; h-- > 0;) {
    grid.horizontal.push_back(2.0 * last - grid.horizontal[h]);
    for (std::size_t v = 0; v < rows; ++v) grid.values.push_back(grid.value(h, v));
  }
}

void mirrorAtFirst(IesGrid& grid) {
  IesGrid mirrored{grid.vertical, {}, {}};
  for (std::size_t h = grid.horizontal.size(); h-- > 1;) {
    mirrored.horizontal.push_back(2.0 * grid.horizontal[0] - grid.horizontal[h]);
    for (std::size_t v = 0; v < grid.vertical.size(); ++v) mirrored.values.push_back(grid.value(h, v));
  }
  mirrored.horizontal.insert(mirrored.horizontal.end(), grid.horizontal.begin(), grid.horizontal.end());
  mirrored.values.insert(mirrored.values.end(), grid.values.begin(), grid.values.end());
  grid = std::move(mirrored);
}

/// Fills in the halves and quarters that profiles of type C leave to symmetry.
void closeCircle(const IesReader& in, IesGrid& grid) {
  const auto goesTo = [&](double first, double last) {
    return grid.horizontal.front() == first && grid.horizontal.back() == last;
  };
  const std::size_t rows = grid.vertical.size();
  if (grid.horizontal.size() == 1) {
    grid.horizontal = {0.0, whole};
    grid.values.resize(2 * rows);
    std::copy_n(grid.values.begin(), rows, grid.values.begin() + static_cast<std::ptrdiff_t>(rows));
    return;
  }
  if (goesTo(0.0, quarter)) mirrorAtLast(grid);
  if (goesTo(0.0, half) || goesTo(quarter, half + quarter)) mirrorAtLast(grid);
  if (grid.horizontal.back() - grid.horizontal.front() == whole) return;
  if (grid.horizontal.front() != 0.0 || grid.horizontal.back() <= half)
    in.fail(fmt::format(
        "the horizontal angles go from {:g} to {:g}, expected 0 to 0, 90, 180 or 360, or 90 to 270",
        grid.horizontal.front(), grid.horizontal.back()));
  if (whole - grid.horizontal.back() < leastStep) {
    grid.horizontal.back() = whole;
    return;
  }
  grid.horizontal.push_back(whole);
  for (std::size_t v = 0; v < rows; ++v) grid.values.push_back(grid.value(0, v));
}

std::vector<double> radians(const std::vector<double>& degrees, double scale, double offset) {
  std::vector<double> angles;
  for (const double angle : degrees) angles.push_back((offset + scale * angle) * (std::numbers::pi / half));
  if (scale < 0.0) std::reverse(angles.begin(), angles.end());
  return angles;
}

/// Converts type C: heights are about the axis from which the vertical angles are measured.
LightProfile profileC(const IesReader& in, IesGrid grid) {
  closeCircle(in, grid);
  LightProfile profile;
  profile.heights = radians(grid.vertical, 1.0, 0.0);
  profile.turns = radians(grid.horizontal, 1.0, 0.0);
  profile.values = std::move(grid.values);
  return profile;
}

/// Converts type A: angles are longitudes and latitudes of a globe whose axis is the lamp's upright one.
LightProfile profileA(const IesGrid& grid) {
  LightProfile profile;
  profile.pole = {1.0, 0.0, 0.0};
  profile.start = {0.0, 0.0, -1.0};
  profile.heights = radians(grid.vertical, -1.0, quarter);
  profile.turns = radians(grid.horizontal, 1.0, 0.0);
  for (std::size_t h = 0; h < grid.horizontal.size(); ++h)
    for (std::size_t v = grid.vertical.size(); v-- > 0;) profile.values.push_back(grid.value(h, v));
  return profile;
}

/// Converts type B: as type A with a level axis, so that horizontal angles are latitudes.
LightProfile profileB(const IesGrid& grid) {
  LightProfile profile;
  profile.pole = {0.0, -1.0, 0.0};
  profile.start = {0.0, 0.0, -1.0};
  profile.heights = radians(grid.horizontal, -1.0, quarter);
  profile.turns = radians(grid.vertical, -1.0, 0.0);
  for (std::size_t v = grid.vertical.size(); v-- > 0;)
    for (std::size_t h = grid.horizontal.size(); h-- > 0;) profile.values.push_back(grid.value(h, v));
  return profile;
}

}  // namespace

LightProfile parseIesProfile(std::string_view text, const std::string& where) {
  IesReader in(text, where);
  const bool ballastAndLamp = skipToTilt(in);
  in.number("the number of lamps");
  in.number("the lumens of a lamp");
  double scale = in.within("the candela multiplier", 0.0, largestInput);
  const std::size_t verticals = in.count("the number of vertical angles", 2);
  const std::size_t horizontals = in.count("the number of horizontal angles", 1);
  const double type = in.number("the photometric type");
  if (type != 1.0 && type != 2.0 && type != 3.0)
    in.fail(fmt::format("the photometric type is {:g}, expected 1 (C), 2 (B) or 3 (A)", type));
  const bool typeC = type == 1.0;
  for (const char* what : {"the unit of lengths", "the lamp's width", "its length", "its height"})
    in.number(what);
  scale *= in.within("the ballast factor", 0.0, largestInput);
  const double second = in.number("the factor after the ballast's");
  if (ballastAndLamp) scale *= std::clamp(second, 0.0, largestInput);
  in.number("the input watts");
  if (verticals > mostIntensities / horizontals)
    in.fail(fmt::format("{} x {} angles, expected {} at most", verticals, horizontals, mostIntensities));
  if (verticals + horizontals + verticals * horizontals > in.roomForNumbers())
    in.fail(fmt::format("{} x {} angles, more than the file has room for", verticals, horizontals));
  IesGrid grid;
  grid.vertical =
      readAngles(in, verticals, "a vertical angle", typeC ? 0.0 : -quarter, typeC ? half : quarter);
  grid.horizontal =
      readAngles(in, horizontals, "a horizontal angle", typeC ? 0.0 : -quarter, typeC ? whole : quarter);
  readValues(in, scale, grid);
  if (typeC) return profileC(in, std::move(grid));
  if (grid.horizontal.front() == 0.0) mirrorAtFirst(grid);
  if (grid.horizontal.size() < 2) in.fail("one horizontal angle, expected two at least, or 0 to 90");
  return type == 2.0 ? profileB(grid) : profileA(grid);
}

}  // namespace prelight
