#pragma once

#include <filesystem>
#include <string>

namespace laneloom::dds {

/// The problem with the files of security in a folder, as far as the files show it by themselves; Fast DDS
/// does not tell its reasons. Empty: no problem was found, so that the permissions forbid what is wanted.
std::string identity_problem(const std::filesystem::path& folder);

/// Whether the governance in a folder of DDS-Security wants every message protected, and knows nobody without
/// an identity. False: there is no folder.
bool governance_protects_messages(const std::filesystem::path& folder);

}  // namespace laneloom::dds
