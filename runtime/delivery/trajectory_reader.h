// A trajectory read from a CSV file, ours or another program's, a line at a time: memory does not
// grow with the file. The header is `name [unit]` cells; the column `t` is the time. The text is a
// stranger's: whatever is wrong with it is a fault with its place.
// Tested by tests/runtime/trajectory_reader_test.cpp.
#pragma once

#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace twincraft {

/// What is wrong with a file, or with a place in it.
struct FileFault {
  std::string file;
  std::size_t line = 0, column = 0;  // 1-based, in bytes; line 0: no place
  std::string message;               // as those of Diagnostic
  std::string hint;                  // empty: none
};
/// `a.csv:3:7: error: ...`, and the hint on a line of its own.
std::string to_text(const FileFault& fault);

struct TrajectoryColumn {
  std::string name;                 // empty: such as pandas leaves above an index
  std::optional<std::string> unit;  // as written; nothing: no brackets
  std::size_t place = 0;            // in the header's line [bytes], 1-based
};

/// A number of a file that is not finite: where.
struct NotFinite {
  std::size_t count = 0;
  std::size_t line = 0;  // of the first
  std::string column = {};
};

/// Lines of a stream, however long the stream is.
class LineReader {
 public:
  explicit LineReader(std::istream& in) : in_(in) {}

  /// Without its end; valid until the next call. Nothing at the end, or after a fault.
  std::optional<std::string_view> next();
  /// Of the line that next() gave, from 1 on.
  std::size_t number() const { return number_; }
  /// Empty, or why there are no more lines.
  const std::string& error() const { return error_; }
  /// The line that next() gave has an end of its own.
  bool is_ended() const { return ended_; }
  /// Bytes read so far.
  std::size_t bytes() const { return bytes_; }

 private:
  bool fill();

  std::istream& in_;
  std::string buffer_;
  std::size_t begin_ = 0;  // of what has not been given, in `buffer_`
  std::size_t number_ = 0;
  std::size_t bytes_ = 0;
  bool ended_ = true;
  std::string error_;
};

class TrajectoryReader {
 public:
  /// @param name  what faults call it  @param in  outlives the reader
  TrajectoryReader(std::string name, std::istream& in);

  /// The header. @return whether it has no fault
  bool read_header(std::vector<FileFault>& faults);
  /// In the order of the file, `t` included.
  const std::vector<TrajectoryColumn>& columns() const { return columns_; }
  /// A fault at a column's name.
  FileFault fault_at(std::size_t column, std::string message, std::string hint = {}) const;

  /// From now on next() puts the number of this column, times `factor`, to `place`.
  void bind(std::size_t column, double factor, double& place);

  /// The next sample. @return false at the end of the file and at a fault
  bool next();
  double time() const { return time_; }  // [s] rises from sample to sample
  std::size_t samples() const { return samples_; }
  const std::optional<FileFault>& fault() const { return fault_; }
  /// Among the columns that are bound.
  const NotFinite& not_finite() const { return not_finite_; }
  std::size_t bytes() const { return lines_.bytes(); }

 private:
  struct Target {
    double* place = nullptr;
    double factor = 1.0;
  };

  bool read_columns(std::string_view line, std::vector<FileFault>& faults);
  bool check_columns(std::vector<FileFault>& faults);
  bool read_cells(std::string_view line);
  bool read_cell(std::size_t column, std::string_view cell, std::size_t place);
  bool check_time();
  bool fail(std::size_t place, std::string message, std::string hint = {});

  std::string name_;
  LineReader lines_;
  std::vector<TrajectoryColumn> columns_;
  std::vector<Target> targets_;  // one per column
  std::size_t header_line_ = 0;
  std::size_t time_column_ = 0, time_place_ = 1;
  double time_ = 0.0, earlier_ = 0.0;
  std::size_t samples_ = 0;
  NotFinite not_finite_;
  std::optional<FileFault> fault_;
};

}  // namespace twincraft
