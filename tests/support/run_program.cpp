// See run_program.h. Both outputs are pipes that are read as they fill, so the program never waits
// for room; standard input is a file in memory.
#include "tests/support/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace twincraft::test {
namespace {

// [s] Nothing awaited takes so long, however busy the machine is.
constexpr int kHang = 480;

int checked(int result, const char* what) {
  if (result < 0) throw std::system_error(errno, std::generic_category(), what);
  return result;
}

/// Closed when it goes, and never passed on to a program that another thread starts.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor() { close(); }

  int get() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_ = -1;
};

struct Pipe {
  Descriptor read, write;
  Pipe() {
    std::array<int, 2> ends{};
    checked(::pipe2(ends.data(), O_CLOEXEC), "pipe");
    read = Descriptor(ends[0]);
    write = Descriptor(ends[1]);
  }
};

Descriptor file_in_memory(const std::string& text) {
  Descriptor file(checked(memfd_create("standard input", MFD_CLOEXEC), "memfd_create"));
  for (std::size_t done = 0; done < text.size();)
    done += static_cast<std::size_t>(checked(
        static_cast<int>(::write(file.get(), text.data() + done, text.size() - done)), "write"));
  checked(static_cast<int>(lseek(file.get(), 0, SEEK_SET)), "lseek");
  return file;
}

/// A program that runs, and what it has written so far.
class Running {
 public:
  Running(const std::string& program, const std::vector<std::string>& arguments,
          const ProgramInput& input) {
    const Descriptor in = file_in_memory(input.standard_input);
    Pipe out, err;
    child_ = start(program, arguments, input, {in.get(), out.write.get(), err.write.get()});
    if (input.data) limit_data(*input.data);
    out_ = std::move(out.read);
    err_ = std::move(err.read);
  }

  pid_t id() const { return child_; }

  /// Returns once it has written this to standard error.
  void await(const std::string& awaited) {
    const std::regex pattern(awaited);
    while (!std::regex_search(told_.err, pattern)) {
      if (read_more(kHang)) continue;
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
      throw std::runtime_error("no `" + awaited + "` on standard error: " + told_.err);
    }
  }

  ProgramResult finish() {
    constexpr int kForever = -1;
    while (read_more(kForever)) continue;
    int status = 0;
    while (waitpid(child_, &status, 0) < 0)
      if (errno != EINTR) throw std::runtime_error("waitpid failed");
    told_.exit_code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    return std::move(told_);
  }

 private:
  static pid_t start(const std::string& program, const std::vector<std::string>& arguments,
                     const ProgramInput& input, const std::array<int, 3>& streams) {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    using Output = ProgramInput::Output;
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    for (int i = 0; i < 3; ++i)
      posix_spawn_file_actions_adddup2(&files, streams.at(static_cast<std::size_t>(i)), i);
    if (input.output == Output::kClosed) posix_spawn_file_actions_addclose(&files, STDOUT_FILENO);
    if (input.output == Output::kFullDevice)
      posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/full", O_WRONLY, 0);
    if (!input.folder.empty()) posix_spawn_file_actions_addchdir_np(&files, input.folder.c_str());
    pid_t child = 0;
    const int error = posix_spawn(&child, program.c_str(), &files, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) throw std::runtime_error("cannot start " + program);
    return child;
  }

  /// It runs already, but all that it has counts whenever it asks for more.
  void limit_data(std::size_t bytes) const {
    const rlimit limit{bytes, bytes};
    checked(prlimit(child_, RLIMIT_DATA, &limit, nullptr), "prlimit");
  }

  /// Blocks until the program writes or closes something.
  /// @return false when both outputs are closed, or nothing came for `seconds`
  bool read_more(int seconds) {
    std::array<pollfd, 2> ends{{{out_.get(), POLLIN, 0}, {err_.get(), POLLIN, 0}}};
    if (out_.get() < 0 && err_.get() < 0) return false;
    const int ready = ::poll(ends.data(), ends.size(), seconds < 0 ? -1 : 1000 * seconds);
    if (ready < 0 && errno == EINTR) return true;
    if (checked(ready, "poll") == 0) return false;
    if (ends[0].revents != 0) take(out_, told_.out);
    if (ends[1].revents != 0) take(err_, told_.err);
    return true;
  }

  static void take(Descriptor& from, std::string& to) {
    std::array<char, 1U << 16U> buffer;
    const ssize_t count = ::read(from.get(), buffer.data(), buffer.size());
    if (count > 0) to.append(buffer.data(), static_cast<std::size_t>(count));
    if (count == 0) from.close();
    if (count < 0 && errno != EINTR) checked(-1, "read");
  }

  pid_t child_ = 0;
  Descriptor out_, err_;
  ProgramResult told_;
};

bool has_ended(pid_t child) {
  siginfo_t info{};  // si_pid stays 0 while it runs
  return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) != 0 ||
         info.si_pid != 0;
}

/// Holds SIGCHLD back until it is asked for.
class HeldSignal {
 public:
  HeldSignal() {
    sigemptyset(&held_);
    sigaddset(&held_, SIGCHLD);
    pthread_sigmask(SIG_BLOCK, &held_, &before_);
  }
  ~HeldSignal() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignal(const HeldSignal&) = delete;
  HeldSignal& operator=(const HeldSignal&) = delete;

  /// Blocks until it comes. @return false when it did not
  bool await(int seconds) const {
    const timespec limit{seconds, 0};
    return sigtimedwait(&held_, nullptr, &limit) > 0;
  }

 private:
  sigset_t held_{}, before_{};
};

/// Sends SIGCHLD to this process when a program has worked for so long, as its end does.
class WorkTimer {
 public:
  WorkTimer(pid_t program, double seconds) {
    clockid_t clock{};
    if (clock_getcpuclockid(program, &clock) != 0) throw std::runtime_error("no such program");
    sigevent event{};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGCHLD;
    checked(timer_create(clock, &event, &timer_), "timer_create");
    itimerspec when{};
    when.it_value.tv_sec = static_cast<time_t>(seconds);
    when.it_value.tv_nsec =
        static_cast<long>(1.0e9 * (seconds - static_cast<double>(when.it_value.tv_sec)));
    checked(timer_settime(timer_, TIMER_ABSTIME, &when, nullptr), "timer_settime");
  }
  ~WorkTimer() { timer_delete(timer_); }
  WorkTimer(const WorkTimer&) = delete;
  WorkTimer& operator=(const WorkTimer&) = delete;

 private:
  timer_t timer_{};
};

}  // namespace

ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          const ProgramInput& input) {
  Running running(program, arguments, input);
  if (!input.awaited.empty()) running.await(input.awaited);
  if (input.while_running) input.while_running(running.id());
  return running.finish();
}

void await_work(pid_t program, double seconds) {
  const HeldSignal signal;  // before the look: an end from here on is not missed
  if (has_ended(program)) return;
  const WorkTimer timer(program, seconds);
  if (!signal.await(kHang)) throw std::runtime_error("the program neither works nor ends");
}

ProgramInput signalled_after(const std::string& awaited, int signal) {
  return {.while_running = [signal](pid_t program) { kill(program, signal); }, .awaited = awaited};
}

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
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
  return read_file(std::filesystem::path(path_) / name);
}

bool TemporaryFolder::has(const std::string& name) const {
  return std::filesystem::exists(path_ + "/" + name);
}

}  // namespace twincraft::test
