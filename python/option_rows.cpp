#include "python/option_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "prelight/error.h"
#include "prelight/find_option.h"

namespace prelight::python {

namespace nb = nanobind;

namespace {

[[noreturn]] void refuse(const OptionInfo& row, nb::handle object, bool otherType) {
  const std::string got = nb::repr(object).c_str();
  throw UsageError(
      argumentOf(row),
      fmt::format("got {}{}, expected {}", got,
                  otherType ? " of type " + std::string(nb::type_name(object.type()).c_str()) : "",
                  row.expected()));
}

/// Returns a number, or nothing for an object that is none of the row's kind.
std::optional<double> numberOf(const OptionInfo& row, nb::handle object) {
  if (PyBool_Check(object.ptr())) return std::nullopt;
  double value = 0.0;
  if (row.range.kind == NumberKind::Real) {
    value = PyFloat_AsDouble(object.ptr());
  } else if (PyIndex_Check(object.ptr())) {
    const nb::object whole = nb::steal(PyNumber_Index(object.ptr()));
    value = whole.is_valid() ? PyLong_AsDouble(whole.ptr()) : -1.0;
  } else {
    return std::nullopt;
  }
  if (PyErr_Occurred() == nullptr) return value;
  PyErr_Clear();
  return std::nullopt;
}

const char* kindName(OptionKind kind) {
  switch (kind) {
    case OptionKind::Flag:
      return "flag";
    case OptionKind::Number:
      return "number";
    case OptionKind::Choice:
      return "choice";
    case OptionKind::Own:
      break;
  }
  return "own";
}

}  // namespace

std::string argumentOf(const OptionInfo& row) {
  if (row.argument != nullptr) return row.argument;
  std::string name = row.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string argumentOfField(std::string_view field) {
  if (const OptionInfo* row = findOption(field)) return argumentOf(*row);
  std::string name;  // arrays have arguments of the same name
  for (const char c : field.substr(field.rfind(':') + 1)) {
    if (c >= 'A' && c <= 'Z' && !name.empty()) name += '_';
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

double valueOf(const OptionInfo& row, nb::handle object) {
  switch (row.kind) {
    case OptionKind::Flag:
      if (PyBool_Check(object.ptr())) return object.is(nb::handle(Py_True)) ? 1.0 : 0.0;
      break;
    case OptionKind::Number:
      if (const std::optional<double> value = numberOf(row, object)) {
        if (row.range.allows(*value)) return *value;
        refuse(row, object, false);
      }
      break;
    case OptionKind::Choice:
      if (nb::isinstance<nb::str>(object)) {
        std::string name = nb::cast<std::string>(object);
        std::replace(name.begin(), name.end(), '_', '-');
        for (std::size_t i = 0; i < row.choices.size(); ++i)
          if (name == row.choices[i].name) return static_cast<double>(i);
        refuse(row, object, false);
      }
      break;
    case OptionKind::Own:
      break;
  }
  refuse(row, object, true);
}

nb::object objectOf(const OptionInfo& row, std::optional<double> value) {
  if (!value) return nb::none();
  switch (row.kind) {
    case OptionKind::Flag:
      return nb::bool_(*value != 0.0);
    case OptionKind::Choice:
      return nb::str(row.choices[static_cast<std::size_t>(*value)].name);
    case OptionKind::Number:
      if (row.range.kind == NumberKind::Real) return nb::float_(*value);
      return nb::int_(static_cast<long long>(*value));
    case OptionKind::Own:
      break;
  }
  return nb::none();
}

nb::tuple describe(const OptionInfo& row, std::optional<double> usual) {
  nb::list choices;
  for (const Choice& choice : row.choices) choices.append(nb::str(choice.name));
  return nb::make_tuple(argumentOf(row), kindName(row.kind), row.help, row.unit, objectOf(row, usual),
                        row.expected(), nb::tuple(choices));
}

}  // namespace prelight::python
