#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/distribution.hpp"

/// Figures of tables.
namespace laneloom::evaluation {

/// A value that cannot always be told: a share of nothing, a quantile of no values.
using Figure = std::optional<double>;

inline Figure when(bool known, double value) { return known ? Figure(value) : std::nullopt; }
inline Figure share(double part, double whole) { return when(whole > 0.0, part / whole); }
inline Figure share(std::size_t part, std::size_t whole) {
  return share(static_cast<double>(part), static_cast<double>(whole));
}
inline Figure quantile(const Distribution& of, double share) {
  return when(of.count() > 0, of.quantile(share));
}

/// As text, in a unit of its own such as 100 for per cent; a dash where it cannot be told.
inline std::string cell(Figure figure, int decimals, int width = 0, double unit = 1.0) {
  return figure ? fmt::format("{:>{}.{}f}", *figure * unit, width, decimals)
                : fmt::format("{:>{}}", "-", width);
}
inline nlohmann::json null_or(Figure figure) { return figure ? nlohmann::json(*figure) : nlohmann::json(); }

}  // namespace laneloom::evaluation
