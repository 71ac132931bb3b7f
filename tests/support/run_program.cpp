// See run_program.h. Standard streams are files in a temporary folder, so that no pipe can fill up
// and block the program.
#include "tests/support/run_program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

namespace twincraft::test {
namespace {

pid_t spawn(const std::string& program, const std::vector<std::string>& arguments,
            const TemporaryFolder& streams) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const std::string in = streams.path() + "/in";
  const std::string out = streams.path() + "/out";
  const std::string err = streams.path() + "/err";
  constexpr int kWrite = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, in.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), kWrite, 0600);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), kWrite, 0600);
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), &files, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) throw std::runtime_error("cannot start " + program);
  return child;
}

bool has_ended(pid_t child) {
  siginfo_t info{};  // si_pid stays 0 while it runs
  return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         info.si_pid != 0;
}

/// Returns once the program has written `words` to standard error.
void await_words(const std::string& words, pid_t child, const TemporaryFolder& streams) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::minutes kHangGuard{8};  // nothing awaited takes seconds on an idle machine
  const Clock::time_point begin = Clock::now();
  while (true) {
    const bool ended = has_ended(child);  // before the look: what it wrote last is still seen
    const std::string told = streams.read("err");
    if (told.find(words) != std::string::npos) return;
    if (!ended && Clock::now() - begin < kHangGuard) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      continue;
    }
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    throw std::runtime_error("no `" + words + "` on standard error: " + told);
  }
}

int wait_for(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw std::runtime_error("waitpid failed");
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace

ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          const ProgramInput& input) {
  const TemporaryFolder streams;
  streams.write("in", input.standard_input);
  const pid_t child = spawn(program, arguments, streams);
  if (!input.awaited.empty()) await_words(input.awaited, child, streams);
  if (input.while_running) input.while_running(child);
  const int exit_code = wait_for(child);
  return {exit_code, streams.read("out"), streams.read("err")};
}

void await_work(pid_t program, double seconds) {
  clockid_t clock{};
  if (clock_getcpuclockid(program, &clock) != 0) throw std::runtime_error("no such program");
  timespec worked{};
  while (!has_ended(program) && clock_gettime(clock, &worked) == 0 &&
         static_cast<double>(worked.tv_sec) + 1.0e-9 * static_cast<double>(worked.tv_nsec) <
             seconds)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

ProgramInput signalled_after(const std::string& awaited, int signal) {
  return {"", [signal](pid_t program) { kill(program, signal); }, awaited};
}

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "twincraft-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make " + pattern);
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;  // a folder left behind fails no test
  std::filesystem::remove_all(path_, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& text) const {
  const std::string path = path_ + "/" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

std::string TemporaryFolder::read(const std::string& name) const {
  std::ifstream file(path_ + "/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

bool TemporaryFolder::has(const std::string& name) const {
  return std::filesystem::exists(path_ + "/" + name);
}

}  // namespace twincraft::test
