// What a build tool reads to know when to run again: a rule in the language of Makefiles, as
// compilers write it for -MD, and as Ninja, Make and CMake's DEPFILE take it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace twincraft {

/// `outputs: inputs`. @return nothing where a name has a line break, which the language cannot say
std::optional<std::string> depfile_rule(const std::vector<std::string>& outputs,
                                        const std::vector<std::string>& inputs);

}  // namespace twincraft
