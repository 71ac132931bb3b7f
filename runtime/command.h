// What scsim's commands share: the flags of every run, what is said and where, the spec compiled.
// Tested by tests/agreement/scsim_test.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "compiler/cli.h"
#include "compiler/diag/diagnostics.h"
#include "compiler/pipeline.h"
#include "runtime/report/progress.h"
#include "runtime/report/report.h"

namespace twincraft {

struct CommonOptions {
  CompileRequest request;
  std::string folder;  // empty: no files
  std::string step, integrator, duration;
  int jobs = 0;  // 0: as many as there are cores
  bool quiet = false;
  std::string progress = "auto";
  std::string diagnostics = "text";
  std::vector<std::string> warnings;  // what stands after -W
};

/// @param files  what is written into the folder
void describe_input(CLI::App& app, CommonOptions& options, std::string_view files);
void describe_jobs(CLI::App& app, CommonOptions& options, const std::string& meaning);
void describe_talk(CLI::App& app, CommonOptions& options);

/// `--step` and its like as the overrides they stand for.
void translate_conveniences(CommonOptions& options);

void complain(std::string_view text);
/// To standard output. @return the exit code
int print(std::string_view text);
int print_diagnostics(const Diagnostics& diagnostics, const CommonOptions& options);

/// The flags of a run with these options; progress goes to `bar` if it is to be seen.
RunOptions watched_run(const CommonOptions& options, ProgressBar& bar);
int jobs_of(const CommonOptions& options);

/// Compile, and say what is wrong. @return an exit code, 0 with `result.bundle`
int compile_spec(const CommonOptions& options, Sources& sources, CompileResult& result);

/// What the report will be called; nothing without -o.
std::vector<std::string> report_files(const CommonOptions& options);

/// Whether they could be written, said now rather than after a run of hours. @return the exit code
int check_writable(const std::vector<std::string>& files);

/// @return the exit code
int write_report(const Report& report, const CommonOptions& options);

/// Whether a report for people goes to standard output; with JSON diagnostics that one document
/// holds it.
bool prints_report(const CommonOptions& options);

}  // namespace twincraft
