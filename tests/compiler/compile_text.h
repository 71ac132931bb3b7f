// For tests that compile from text as from a file: all stages, as both programs run them.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compiler/pipeline.h"

namespace twincraft {

struct Compiled {
  LoadedSpec spec;
  Bundle bundle;
};

class CompilesText : public testing::Test {
 protected:
  /// Nothing when the spec or a member of its study has errors.
  std::optional<Compiled> compile_text(const std::string& text,
                                       std::vector<std::string> overrides = {}) {
    // Many tests do this at once, each in a process of its own.
    const std::filesystem::path path =
        std::filesystem::path(testing::TempDir()) / ("text_" + std::to_string(getpid()) + ".yaml");
    std::ofstream(path) << text;
    LoadResult loaded = load_spec({path.string(), std::move(overrides)}, diagnostics_);
    std::filesystem::remove(path);
    if (!loaded.spec) return std::nullopt;
    std::optional<Bundle> bundle =
        loaded.spec->compile({kMjcf, kAssemblyJson, kResolved}, diagnostics_);
    if (bundle) loaded.spec->check_members(diagnostics_);
    if (diagnostics_.has_errors()) return std::nullopt;
    return Compiled{*std::move(loaded.spec), *std::move(bundle)};
  }

  Diagnostics diagnostics_;
};

}  // namespace twincraft
