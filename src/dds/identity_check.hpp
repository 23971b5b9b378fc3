#pragma once

#include <filesystem>
#include <string>

namespace laneloom::dds {

/// What is wrong with the files of security in a folder, as far as they say by themselves; Fast DDS keeps its
/// reasons to itself. Empty where nothing is found: then it is what the permissions say.
std::string identity_problem(const std::filesystem::path& folder);

}  // namespace laneloom::dds
