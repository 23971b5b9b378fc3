#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include "base/left_out.hpp"

/// Checked reading of comma-separated values without quotes.
namespace laneloom::io {

/// Calls visit(row) for every line except the first, which must name `columns`, and may name others behind
/// them. Throws std::runtime_error naming the file if it cannot be read or has other columns. Adds file and
/// line to a std::runtime_error that visit() throws.
void for_each_csv_row(const std::filesystem::path& path, std::string_view columns,
                      const std::function<void(std::string_view)>& visit);

/// Does the same, but leaves rows out whose visit() throws, unless `left_out` is strict.
void for_each_csv_row(const std::filesystem::path& path, std::string_view columns, LeftOut& left_out,
                      const std::function<void(std::string_view)>& visit);

/// Takes the first field off a row.
inline std::string_view take_field(std::string_view& row) {
  const std::size_t comma = std::min(row.find(','), row.size());
  const std::string_view field = row.substr(0, comma);
  row.remove_prefix(std::min(comma + 1, row.size()));
  return field;
}

/// Takes the first field off a row, as a finite number, or as a whole one. Throws std::runtime_error if it is
/// none.
template <typename Number>
Number take_number(std::string_view& row) {
  const std::string_view field = take_field(row);
  Number value{};
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size())
    throw std::runtime_error(std::is_integral_v<Number> ? "a whole number is expected"
                                                        : "a number is expected");
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(value)) throw std::runtime_error("a finite number is expected");
  return value;
}

}  // namespace laneloom::io
