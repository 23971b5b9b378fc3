#pragma once

#include <string>
#include <vector>

/// Checks of the files that a command is given, before it opens any. A name that is empty is no file.
namespace laneloom::commands {

/// Throws std::runtime_error naming an output that would be written over an input or another output, if there
/// is one. Two paths of one file are the same, also where it is not there yet.
void refuse_overwriting(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs);

/// Throws std::runtime_error if standard input would be read twice: if it is two of the inputs, or if it is
/// one of them and `option`, where that is given, reads inputs twice.
void refuse_second_reading(const std::vector<std::string>& inputs, const std::string& option = {});

}  // namespace laneloom::commands
