#pragma once

#include <filesystem>
#include <string>

namespace laneloom::dds {

/// The problem with the files of security in a folder, as far as the files show it by themselves; Fast DDS
/// does not tell its reasons. Empty: no problem was found, so that the permissions forbid what is wanted.
std::string identity_problem(const std::filesystem::path& folder);

}  // namespace laneloom::dds
