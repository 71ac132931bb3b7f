// sccompile: flags to pipeline to exit code. Results go to standard output or to files, diagnostics
// to standard error. Tested by tests/malformed and tests/compiler/sccompile_test.cpp.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "compiler/diag/print.h"
#include "compiler/emit/target.h"
#include "compiler/files/output.h"
#include "compiler/pipeline.h"
#include "runtime/delivery/compiled_spec.h"
#include "runtime/delivery/spec_proof.h"
#include "tools/programs/cli.h"
#include "tools/programs/depfile.h"
#include "tools/programs/progress.h"

namespace twincraft {
namespace {

const std::vector<std::string> kFormats = {"text", "json", "sarif"};
const std::vector<std::string> kLists = {"inputs", "outputs"};

struct Options {
  CompileRequest request;
  std::string folder = ".";
  std::string emit = fmt::format("{},{}", kMjcf, kAssemblyJson);
  std::string diagnostics = "text";
  int max_errors = static_cast<int>(PrintOptions{}.max_errors);
  std::vector<std::string> warnings;  // what stands after -W
  bool check = false;
  std::string depfile;  // empty: none
  std::string list;     // empty, or one of kLists
  std::string explain;
  bool schema = false;
  bool reference = false;
  std::vector<const Target*> targets;  // of `emit`
};

void complain(const std::string& text) {
  write_standard_error(fmt::format("sccompile: {}\n", text));
}

int usage(const std::string& text, const std::string& hint) {
  return report_usage("sccompile", text, hint);
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& words) {
  const std::string near = nearest(word, words);
  return near.empty() ? fmt::format("one of {}", fmt::join(words, ", "))
                      : fmt::format("did you mean `{}`?", near);
}

std::vector<std::string> target_names() {
  std::vector<std::string> names;
  for (const Target& target : targets()) names.emplace_back(target.name);
  return names;
}

/// A line for each: what it is called and what it writes.
std::string target_lines() {
  std::string lines;
  for (const Target& target : targets())
    lines += fmt::format("  {:<9} DIR/NAME{:<15} {}\n", target.name, target.suffix, target.what);
  return lines;
}

void describe(CommandLine& line, Options& options) {
  line.add_text("SPEC", options.request.file, "", "spacecraft spec, or - for standard input");
  line.add_text("-o,--output", options.folder, "DIR",
                "folder of the results, or - for standard output");
  line.add_text("--emit", options.emit, "LIST",
                fmt::format("what to write (default {})", options.emit));
  line.add_list("--set", options.request.overrides, "PATH=VALUE",
                "change the spec first; repeatable");
  line.add_switch("--check", options.check, "write nothing; prove both targets to be one machine");
  line.add_text("--depfile", options.depfile, "FILE",
                "write what was read, as a Makefile rule of the results");
  line.add_text("--list", options.list, "WHAT",
                "write nothing; print the names of the `inputs` or `outputs`", {one_of(kLists)});
  line.add_text("--diagnostics", options.diagnostics, "FORMAT", "text (default), json or sarif");
  line.add_number("--max-errors", options.max_errors, 1, 1'000'000,
                  "show this many errors (default 50)");
  add_warning_flags(line, options.warnings);
  line.add_text("--explain", options.explain, "CODE", "what a diagnostic code means, and the cure");
  line.add_switch("--schema", options.schema, "print the JSON Schema of the spec language");
  line.add_switch("--reference", options.reference, "print the reference of the spec language");
  line.add_version("sccompile " TWINCRAFT_VERSION);
  line.add_footer(
      "Results:\n" + target_lines() +
      "\nExit: 0 done, 1 the spec has faults, 2 usage, 3 input/output, 4 internal failure.\n"
      "Example: sccompile models/quickstart.yaml -o out --set wheels.rw_x.speed='6000 rpm'");
}

/// @return an exit code, or nothing when the values make sense
std::optional<int> refuse_bad_values(Options& options) {
  if (std::find(kFormats.begin(), kFormats.end(), options.diagnostics) == kFormats.end()) {
    return usage("`--diagnostics` cannot be " + in_backticks(options.diagnostics),
                 did_you_mean(options.diagnostics, kFormats));
  }
  std::istringstream list(options.emit);
  for (std::string word; std::getline(list, word, ',');) {
    const std::string name = trimmed(word);
    const Target* target = find_target(name);
    if (target == nullptr)
      return usage("`--emit` cannot be " + in_backticks(name), did_you_mean(name, target_names()));
    options.targets.push_back(target);
  }
  const bool to_stdout = options.folder == "-" && !options.check;
  if (to_stdout && options.targets.size() != 1) {
    return usage("`-o -` writes a single result", "choose it, for example with `--emit mjcf`");
  }
  if (to_stdout && !options.depfile.empty()) {
    return usage("`--depfile` names the files that are written, and `-o -` writes none",
                 "write to a folder");
  }
  if ((to_stdout || !options.list.empty()) && options.diagnostics != "text") {
    return usage(fmt::format("`{}` and `--diagnostics` both want standard output",
                             to_stdout ? "-o -" : "--list"),
                 to_stdout ? "write to a folder" : "leave `--diagnostics` out");
  }
  const bool needs_spec = !options.schema && !options.reference && options.explain.empty();
  if (needs_spec && options.request.file.empty()) {
    return usage("SPEC is missing", "for example `sccompile models/quickstart.yaml -o out`");
  }
  return std::nullopt;
}

/// What is written on the command line and has no effect beside another flag is said.
void warn_of_idle_flags(const CommandLine& line, const Options& options) {
  const auto warn = [&line](const char* busy, std::initializer_list<const char*> idle) {
    for (const char* name : idle)
      if (line.has(name))
        complain(fmt::format("warning: `{}` has no effect with `{}`", name, busy));
  };
  if (options.check) warn("--check", {"-o", "--emit", "--depfile", "--list"});
  if (!options.list.empty()) warn("--list", {"--depfile"});
  for (const char* only : {"--schema", "--reference", "--explain"})
    if (line.has(only))
      warn(only, {"SPEC", "-o", "--emit", "--set", "--check", "--depfile", "--list"});
}

/// A document, for programs: its bytes reach them as they are.
int print(const std::string& document) {
  const std::string error = write_document(document);
  if (error.empty()) return kExitDone;
  complain(error);
  return kExitInputOutput;
}

/// @return kExitDone, or kExitInputOutput when standard output is closed
int report(const Diagnostics& diagnostics, const Options& options) {
  if (options.diagnostics == "json") return print(to_json(diagnostics));
  if (options.diagnostics == "sarif") return print(to_sarif(diagnostics));
  write_standard_error(to_text(
      diagnostics, {wants_colour(STDERR_FILENO), static_cast<std::size_t>(options.max_errors)}));
  return kExitDone;
}

struct Results {
  std::vector<OutputFile> files;
  int code = kExitDone;  // kExitFindings when one cannot be written
};

Results results_of(const Bundle& bundle, const Options& options) {
  Results results;
  for (const Target* target : options.targets) {
    const std::string name = fmt::format("{}{}", bundle.model.name, target->suffix);
    if (const auto refused = bundle.refused.find(target->name); refused != bundle.refused.end()) {
      complain(fmt::format("`{}` is not written: {}", name, refused->second));
      results.code = kExitFindings;
      continue;
    }
    results.files.push_back(
        {(std::filesystem::path(options.folder) / name).string(), bundle.text(target->name)});
  }
  return results;
}

std::vector<std::string> paths_of(const std::vector<OutputFile>& files) {
  std::vector<std::string> paths;
  for (const OutputFile& file : files) paths.push_back(file.path);
  return paths;
}

int write_results(Results results, const LoadedSpec& spec, const Options& options) {
  if (options.folder == "-")
    return results.files.empty() ? results.code : print(results.files.front().text);
  if (!options.depfile.empty()) {
    const std::optional<std::string> rule = depfile_rule(paths_of(results.files), spec.files());
    if (!rule) {
      complain("a depfile cannot name a file whose name has a line break");
      return kExitInputOutput;
    }
    results.files.push_back({options.depfile, *rule});
  }
  const std::string error = write_files(results.files);
  if (error.empty()) return results.code;
  complain(error);
  return kExitInputOutput;
}

int list(const Results& results, const LoadedSpec& spec, const Options& options) {
  std::string lines;
  for (const std::string& path : options.list == "inputs" ? spec.files() : paths_of(results.files))
    lines += path + '\n';
  const int code = print(lines);
  return code == kExitDone ? results.code : code;
}

int check(const Bundle& bundle, const Options& options) {
  ProgressBar bar(stderr);
  const bool is_watched = ::isatty(STDERR_FILENO) != 0;
  const SpecProof proof = prove_spec(bundle, [&bar, is_watched](double done) {
    if (is_watched) bar.show("proof", done);
  });
  bar.clear();
  if (options.diagnostics == "text") {
    if (const int code = print(proof.text()); code != kExitDone) return code;
  } else {
    write_standard_error(proof.text());  // standard output is for one document
  }
  return proof.exit_code();
}

Wanted wanted_by(const Options& options) {
  if (options.check) return {kMjcf};
  Wanted wanted;
  for (const Target* target : options.targets) wanted.push_back(target->name);
  return wanted;
}

int run(const Options& options) {
  if (options.schema) return print(json_schema());
  if (options.reference) return print(reference_markdown());
  if (!options.explain.empty()) return explain_code("sccompile", options.explain);

  Diagnostics diagnostics;
  const Compilation made = compile_spec(options.request, wanted_by(options), diagnostics);
  if (!made.io_error.empty()) {
    complain(made.io_error);
    return kExitInputOutput;
  }
  if (made.compiled && options.check) foresee_step(*made.compiled, diagnostics);
  judge_warnings(options.warnings, diagnostics);
  if (const int code = report(diagnostics, options); code != kExitDone) return code;
  if (const int code = made.exit_code(diagnostics); code != kExitDone) return code;
  const Bundle& bundle = made.compiled->bundle;
  if (options.check) return check(bundle, options);
  Results results = results_of(bundle, options);
  if (!options.list.empty()) return list(results, made.compiled->spec, options);
  return write_results(std::move(results), made.compiled->spec, options);
}

int parse_and_run(int argc, char** argv) {
  CommandLine line{"Compiles a spacecraft spec into an effector assembly and MJCF.", "sccompile"};
  Options options;
  describe(line, options);
  if (const std::optional<int> code = line.parse(argc, argv)) return *code;
  if (const std::optional<int> code = refuse_bad_values(options)) return *code;
  warn_of_idle_flags(line, options);
  return run(options);
}

}  // namespace
}  // namespace twincraft

int main(int argc, char** argv) {
  return twincraft::run_program("sccompile", [=] { return twincraft::parse_and_run(argc, argv); });
}
