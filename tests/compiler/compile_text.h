// For tests that compile from text as from a file: all stages, as both programs run them.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "compiler/pipeline.h"

namespace twincraft {

class CompilesText : public testing::Test {
 protected:
  CompileResult compile_text(const std::string& text, std::vector<std::string> overrides = {}) {
    // Many tests do this at once, each in a process of its own.
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / ("text_" + std::to_string(getpid()) + ".yaml");
    std::ofstream(path) << text;
    CompileResult result = compile({path.string(), std::move(overrides)}, sources_, diagnostics_);
    std::filesystem::remove(path);
    return result;
  }

  Sources sources_;
  Diagnostics diagnostics_;
};

}  // namespace twincraft
