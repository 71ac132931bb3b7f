// What scsim's commands share: the flags of every run, what is said and where, the spec compiled.
// Tested by tests/agreement/scsim_test.cpp.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diag/diagnostics.h"
#include "compiler/pipeline.h"
#include "runtime/delivery/compiled_spec.h"
#include "runtime/study/member.h"
#include "tools/programs/cli.h"
#include "tools/programs/progress.h"

namespace twincraft {

struct CommonOptions {
  CompileRequest request;
  std::string folder;  // empty: no files
  std::string step, integrator, duration;
  int jobs = 0;  // 0: as many as there are cores
  bool quiet = false;
  std::string isa = "auto";
  std::string progress = "auto";
  std::string diagnostics = "text";
  std::vector<std::string> warnings;  // what stands after -W
  std::string explain;                // a diagnostic code: print its long text, run nothing
};

/// @param files  what is written into the folder
void describe_input(CommandLine& line, CommonOptions& options, std::string_view files);
void describe_jobs(CommandLine& line, CommonOptions& options, const std::string& meaning);
void describe_instructions(CommandLine& line, CommonOptions& options);
void describe_talk(CommandLine& line, CommonOptions& options);

/// What the flags say by themselves: a code to explain, flags that exclude each other, no spec.
/// `--step` and its like become the overrides they stand for.
/// @return the exit code, or nothing to go on
std::optional<int> settle_flags(std::string_view program, CommonOptions& options);

void complain(std::string_view text);
/// To standard output. @return the exit code
int print(std::string_view text);
int print_diagnostics(const Diagnostics& diagnostics, const CommonOptions& options);

/// What the flags say of every run: its instructions, and who watches it; a signal stops it, and
/// progress goes to `bar` if it is to be seen.
void watch(RunOptions& run, const CommonOptions& options, ProgressBar& bar);
bool shows_progress(const CommonOptions& options);
int jobs_of(const CommonOptions& options);
/// Compile, and say what is wrong with the spec and its members. @return an exit code, 0 with a
/// `result`
int compile_spec(const CommonOptions& options, const Wanted& wanted,
                 std::optional<CompiledSpec>& result);

/// Says what went wrong with files, if anything did. @return the exit code
int settle(const std::string& error);

/// Says on standard error what was written, unless `--quiet`. @param files  names in the folder
void tell_written(const std::vector<std::string>& files, const CommonOptions& options);

/// Whether a report for people goes to standard output; with JSON diagnostics that one document
/// holds it.
bool prints_report(const CommonOptions& options);

}  // namespace twincraft
