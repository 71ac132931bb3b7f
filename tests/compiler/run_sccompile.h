// Runs the real program, as a user would.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace twincraft::test {

struct Outcome {
  int exit_code = 0;
  std::string output;
};

/// `arguments` is shell text after the program's name; standard output is kept, standard error only
/// with a redirection such as `2>&1`.
inline Outcome run_sccompile(const std::string& arguments,
                             const std::string& folder = TWINCRAFT_ROOT) {
  const std::string command = "cd '" + folder + "' && '" SCCOMPILE "' " + arguments;
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  Outcome run;
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    run.output.append(buffer.data(), count);
  }
  const int status = ::pclose(pipe);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return run;
}

}  // namespace twincraft::test
