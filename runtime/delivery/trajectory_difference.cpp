#include "runtime/delivery/trajectory_difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>

#include "compiler/diag/diagnostics.h"
#include "compiler/syntax/load.h"

namespace twincraft {
namespace {

namespace fs = std::filesystem;

constexpr double kSameTime = 1.0e-9;       // [s] how far two times that are one may be apart
constexpr std::size_t kShownEvery = 4096;  // samples between two looks at the progress

/// Empty, or why the file can not be read. A FIFO could block for ever, a device never ends.
std::string unreadable(const std::string& path) {
  std::error_code fault;
  const fs::file_status status = fs::status(path, fault);
  if (status.type() == fs::file_type::not_found) {
    const std::string near = near_file(path);
    return "no such file or directory" +
           (near.empty() ? std::string() : fmt::format("; did you mean {}?", in_backticks(near)));
  }
  if (fault) return reason_of(fault);
  if (fs::is_directory(status)) return "it is a directory";
  return fs::is_regular_file(status) ? std::string() : "it is not a regular file";
}

/// One of the two files: its samples as they come.
class Side {
 public:
  explicit Side(const std::string& path)
      : path_(path), file_{.name = path}, reader_(path, stream_) {}
  Side(const Side&) = delete;
  Side& operator=(const Side&) = delete;

  bool open(std::vector<FileFault>& faults) {
    std::string error = unreadable(path_);
    if (error.empty()) {
      errno = 0;
      stream_.open(path_, std::ios::binary);
      if (!stream_) error = reason_of({errno, std::generic_category()});
    }
    if (error.empty()) {
      std::error_code unknown;
      bytes_ = static_cast<double>(fs::file_size(path_, unknown));
      return reader_.read_header(faults);
    }
    faults.push_back({path_, 0, 0, "it can not be read: " + error, ""});
    return false;
  }

  /// @pre open
  void bind(const SharedColumns& shared, bool is_a) {
    for (const Coordinate& coordinate : shared.model.coordinates)
      grow(coordinate.is_wheel() ? seen_.wheel_rate : seen_.joint_position, coordinate.entry());
    seen_.joint_rate.resize(seen_.joint_position.size());
    others_.resize(shared.others.size());
    const auto bind_one = [this, is_a](const SharedColumn& column, double& place) {
      reader_.bind(is_a ? column.a : column.b, is_a ? column.factor_a : column.factor_b, place);
    };
    for (const SharedColumns::Measured& each : shared.measured) {
      bind_one(each.column, place_of(each.output, each.component, seen_));
      has_attitude_ = has_attitude_ || each.output.of == OutputSignal::Of::kAttitude;
    }
    for (std::size_t i = 0; i < others_.size(); ++i) bind_one(shared.others[i], others_[i]);
  }

  /// The next sample, if there is one.
  void advance() {
    has_sample_ = reader_.next();
    if (!has_sample_) return;
    seen_.time = reader_.time();
    if (has_attitude_) settle_attitude();
  }
  bool has_sample() const { return has_sample_; }
  const Observation& seen() const { return seen_; }
  const std::vector<double>& others() const { return others_; }

  /// The present sample has no partner.
  void leave_alone() {
    if (++file_.lone_times == 1) file_.first_lone = seen_.time;
  }

  TrajectoryReader& reader() { return reader_; }
  double fraction() const {
    return bytes_ > 0.0 ? std::min(1.0, static_cast<double>(reader_.bytes()) / bytes_) : 1.0;
  }
  ComparedFile file() const {
    ComparedFile file = file_;
    file.not_finite = reader_.not_finite();
    return file;
  }

 private:
  static void grow(std::vector<double>& values, std::size_t entry) {
    if (values.size() <= entry) values.resize(entry + 1);
  }

  /// Of any length, it is an attitude; of length 0 it is none, and must not pass for one. Scaled by
  /// a power of two, which rounds nothing, its products neither overflow nor vanish.
  void settle_attitude() {
    const double length = seen_.q_BN.coeffs().stableNorm();
    if (std::isnormal(length)) {
      seen_.q_BN.coeffs() *= std::ldexp(1.0, -std::ilogb(length));
      return;
    }
    if (!std::isfinite(length)) return;
    if (++file_.null_attitudes == 1) file_.first_null = seen_.time;
    seen_.q_BN.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
  }

  std::string path_;
  ComparedFile file_;
  std::ifstream stream_;
  double bytes_ = 0.0;
  TrajectoryReader reader_;
  Observation seen_;
  std::vector<double> others_;
  bool has_attitude_ = false;
  bool has_sample_ = false;
};

/// Walks both files, and meets the samples of one time.
class Merge {
 public:
  Merge(Side& a, Side& b, TrajectoryDifference& difference, const CompareProgress& progress)
      : a_(a), b_(b), difference_(difference), progress_(progress), meter_(difference.shared.laws) {
    for (const SharedColumn& column : difference.shared.others)
      difference_.others.push_back({column.name, column.unit, {}});
  }

  void run() {
    a_.advance();
    b_.advance();
    for (std::size_t i = 1; a_.has_sample() || b_.has_sample(); ++i) {
      step();
      if (a_.reader().fault() || b_.reader().fault()) return;
      if (progress_ && i % kShownEvery == 0) progress_(0.5 * (a_.fraction() + b_.fraction()));
    }
    difference_.comparison = meter_.result(is_whole());
  }

 private:
  void step() {
    const double none = std::numeric_limits<double>::infinity();
    const double time_a = a_.has_sample() ? a_.seen().time : none;
    const double time_b = b_.has_sample() ? b_.seen().time : none;
    if (std::abs(time_a - time_b) <= kSameTime) {
      meet();
      a_.advance();
      b_.advance();
      return;
    }
    Side& earlier = time_a < time_b ? a_ : b_;
    earlier.leave_alone();
    earlier.advance();
  }

  void meet() {
    const double time = a_.seen().time;
    if (difference_.times++ == 0) difference_.first_time = time;
    difference_.last_time = time;
    meter_.take(a_.seen(), b_.seen());
    for (std::size_t i = 0; i < difference_.others.size(); ++i)
      difference_.others[i].peak.see(std::abs(a_.others()[i] - b_.others()[i]), time);
  }

  bool is_whole() const { return a_.file().lone_times + b_.file().lone_times == 0; }

  Side &a_, &b_;
  TrajectoryDifference& difference_;
  const CompareProgress& progress_;
  AgreementMeter meter_;
};

std::string span_of(const TrajectoryReader& reader, const ComparedFile& file) {
  if (reader.samples() == 0) return fmt::format("{} has no sample", in_backticks(file.name));
  return fmt::format("{} has {} from {:g} s to {:g} s", in_backticks(file.name), reader.samples(),
                     file.first_lone, reader.time());
}

/// Every time is alone.
FileFault no_common_time(Side& a, Side& b) {
  return {a.file().name, 0, 0,
          fmt::format("no time in common with {} to within {:g} s", in_backticks(b.file().name),
                      kSameTime),
          fmt::format("{}, {}; nothing is interpolated: record both at the same times",
                      span_of(a.reader(), a.file()), span_of(b.reader(), b.file()))};
}

FileFault no_common_column(const std::string& a, const std::string& b) {
  return {a, 0, 0, fmt::format("no column in common with {} but `t`", in_backticks(b)),
          "columns are compared by name, such as `q_BN.w [1]`; docs/outputs.md lists the names"};
}

}  // namespace

std::string reason_of(const std::error_code& fault) {
  std::string text = fault.message();
  if (!text.empty() && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] + 32);
  return text;
}

std::optional<TrajectoryDifference> compare_trajectories(const std::string& a, const std::string& b,
                                                         const Model* spec,
                                                         std::vector<FileFault>& faults,
                                                         const CompareProgress& progress) {
  const std::size_t before = faults.size();
  Side side_a(a), side_b(b);
  const bool open_a = side_a.open(faults), open_b = side_b.open(faults);
  if (!open_a || !open_b) return std::nullopt;
  TrajectoryDifference difference;
  difference.shared = share_columns(side_a.reader(), side_b.reader(), spec, faults);
  if (faults.size() > before) return std::nullopt;
  if (difference.shared.empty()) {
    faults.push_back(no_common_column(a, b));
    return std::nullopt;
  }
  side_a.bind(difference.shared, true);
  side_b.bind(difference.shared, false);
  Merge(side_a, side_b, difference, progress).run();
  for (Side* side : {&side_a, &side_b})
    if (const auto& fault = side->reader().fault()) faults.push_back(*fault);
  if (faults.size() == before && difference.times == 0)
    faults.push_back(no_common_time(side_a, side_b));
  if (faults.size() > before) return std::nullopt;
  difference.a = side_a.file();
  difference.b = side_b.file();
  return difference;
}

}  // namespace twincraft
