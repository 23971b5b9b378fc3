#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace laneloom::io {

/// Calls visit(element) for every object of an array in a JSON file, one after the other, so that a large
/// array need not fit into memory. The array is the whole file, or with a `key` the root object's member of
/// that name. Throws std::runtime_error naming the file if it cannot be read, is not JSON, or has no such
/// array of objects. Adds file and index of the element to a JsonError that visit() throws.
void for_each_json_object(const std::filesystem::path& path, const std::string& key,
                          const std::function<void(const nlohmann::json&)>& visit);

/// Does the same for an object of objects, which is the root object's member `key`: calls visit(name, object)
/// for its members.
void for_each_json_member(const std::filesystem::path& path, const std::string& key,
                          const std::function<void(const std::string&, const nlohmann::json&)>& visit);

}  // namespace laneloom::io
