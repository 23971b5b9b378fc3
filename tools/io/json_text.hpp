#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace laneloom::io {

/// JSON that may hold words of others: names of files, damage of recordings. What is no UTF-8 in them is
/// replaced. `indent` -1: all is in one line.
inline std::string json_text(const nlohmann::json& value, int indent = -1) {
  return value.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace laneloom::io
