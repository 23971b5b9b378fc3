#pragma once

#include <string>
#include <vector>

/// Checks of the files that a command is given, before it opens any. A name that is empty is no file.
namespace laneloom::commands {

/// Throws std::runtime_error naming an output that would be written over an input or another output, if there
/// is one. Two paths of one file are the same, also where it is not there yet.
void refuse_overwriting(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

}  // namespace laneloom::commands
