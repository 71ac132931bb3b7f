// Own code and no library: the libraries of Debian know no places, and places are most of this
// file. A cell may stand in double quotes; a line is a record, so no cell spans lines.
#include "runtime/delivery/trajectory_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <utility>

#include "compiler/diag/diagnostics.h"
#include "compiler/ir/number.h"
#include "compiler/units/units.h"

namespace twincraft {
namespace {

constexpr std::size_t kChunk = 1u << 16;         // [bytes] read at a time
constexpr std::size_t kLongestLine = 16u << 20;  // [bytes] 600 000 columns, or no CSV at all

constexpr std::string_view kBlanks = " \t";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

/// Takes the cells of a line, one after another.
class Cells {
 public:
  explicit Cells(std::string_view line) : line_(line) {}

  /// @pre not at_end()
  std::string_view next() {
    place_ = at_ + 1;
    const std::size_t first = line_.find_first_not_of(kBlanks, at_);
    if (first != std::string_view::npos && line_[first] == '"') return quoted(first);
    const std::size_t comma = std::min(line_.find(',', at_), line_.size());
    return trimmed(line_.substr(std::exchange(at_, comma + 1), comma - (place_ - 1)));
  }
  bool at_end() const { return at_ > line_.size(); }
  /// Of the cell that next() gave [bytes], 1-based.
  std::size_t place() const { return place_; }
  /// The cell's quotes are not closed, or something follows them.
  bool is_malformed() const { return malformed_; }

 private:
  std::string_view quoted(std::size_t first) {
    std::size_t last = line_.find('"', first + 1);
    while (last != std::string_view::npos && line_.substr(last + 1).starts_with('"'))
      last = line_.find('"', last + 2);  // `""` is a quote inside
    const std::size_t end = last == std::string_view::npos
                                ? line_.size()
                                : std::min(line_.find(',', last), line_.size());
    malformed_ =
        last == std::string_view::npos || !trimmed(line_.substr(last + 1, end - last - 1)).empty();
    at_ = end + 1;
    return malformed_ ? std::string_view() : trimmed(line_.substr(first + 1, last - first - 1));
  }

  std::string_view line_;
  std::size_t at_ = 0;
  std::size_t place_ = 1;
  bool malformed_ = false;
};

/// Nothing for what is no number; `nan` and `inf` are numbers that are not finite.
std::optional<double> number_in(std::string_view cell) {
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);
  double value = 0.0;
  const auto [end, fault] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (end != cell.data() + cell.size() || fault == std::errc::invalid_argument) return std::nullopt;
  // Too large or too small for a double: infinite, or zero.
  if (fault != std::errc()) value = std::strtod(std::string(cell).c_str(), nullptr);
  return value;
}

/// `r_BN_N.x [m]`
TrajectoryColumn column_of(std::string_view cell, std::size_t place) {
  const std::size_t open = cell.rfind('[');
  if (open == std::string_view::npos || !cell.ends_with(']'))
    return {std::string(cell), std::nullopt, place};
  const std::string_view unit = cell.substr(open + 1, cell.size() - open - 2);
  return {std::string(trimmed(cell.substr(0, open))), std::string(trimmed(unit)), place};
}

bool is_no_text(char c) { return static_cast<unsigned char>(c) < ' ' && c != '\t'; }

std::string hint_for_cell(std::string_view cell) {
  constexpr std::string_view kMissing = "write `nan` for a value that is missing";
  for (const std::string_view word : {"", "NA", "N/A", "null", "None", "-"})
    if (cell == word) return std::string(kMissing);
  return {};
}

}  // namespace

std::string to_text(const FileFault& fault) {
  std::string text = printable(fault.file);
  if (fault.line > 0) text += fmt::format(":{}:{}", fault.line, fault.column);
  text += fmt::format(": error: {}\n", fault.message);
  if (!fault.hint.empty()) text += fmt::format("  hint: {}\n", fault.hint);
  return text;
}

bool LineReader::fill() {
  buffer_.erase(0, std::exchange(begin_, 0));
  const std::size_t kept = buffer_.size();
  if (kept > kLongestLine) {
    error_ = fmt::format("a line is longer than {} MiB", kLongestLine >> 20);
    return false;
  }
  buffer_.resize(kept + kChunk);
  in_.read(buffer_.data() + kept, static_cast<std::streamsize>(kChunk));
  const auto count = static_cast<std::size_t>(in_.gcount());
  buffer_.resize(kept + count);
  bytes_ += count;
  if (in_.bad()) error_ = "it can not be read to its end";
  return count > 0 && error_.empty();
}

std::optional<std::string_view> LineReader::next() {
  std::size_t searched = begin_;
  while (error_.empty()) {
    const std::size_t end = buffer_.find('\n', searched);
    if (end != std::string::npos) {
      std::string_view line(buffer_.data() + begin_, end - begin_);
      begin_ = end + 1;
      ++number_;
      if (line.ends_with('\r')) line.remove_suffix(1);
      return line;
    }
    searched = buffer_.size() - begin_;  // where that is after fill()
    if (fill()) continue;
    if (!error_.empty() || begin_ == buffer_.size()) break;
    ended_ = false;
    ++number_;
    return std::string_view(buffer_).substr(std::exchange(begin_, buffer_.size()));
  }
  return std::nullopt;
}

TrajectoryReader::TrajectoryReader(std::string name, std::istream& in)
    : name_(std::move(name)), lines_(in) {}

FileFault TrajectoryReader::fault_at(std::size_t column, std::string message,
                                     std::string hint) const {
  return {name_, header_line_, columns_[column].place, std::move(message), std::move(hint)};
}

bool TrajectoryReader::read_header(std::vector<FileFault>& faults) {
  std::optional<std::string_view> line = lines_.next();
  if (line && line->starts_with("\xEF\xBB\xBF")) line->remove_prefix(3);
  while (line && trimmed(*line).empty()) line = lines_.next();
  header_line_ = lines_.number();
  if (!line) {
    const bool is_empty = lines_.error().empty();
    faults.push_back({name_, 0, 0, is_empty ? "the file is empty" : lines_.error(),
                      "a trajectory is a CSV file with a header, such as `t [s],q_BN.w [1]`"});
    return false;
  }
  if (const auto byte = std::ranges::find_if(*line, is_no_text); byte != line->end()) {
    const auto place = static_cast<std::size_t>(byte - line->begin()) + 1;
    faults.push_back({name_, header_line_, place,
                      fmt::format("the header is no text: byte 0x{:02x}",
                                  static_cast<unsigned>(static_cast<unsigned char>(*byte))),
                      "a CSV file is expected, not packed and in UTF-8"});
    return false;
  }
  return read_columns(*line, faults) && check_columns(faults);
}

bool TrajectoryReader::read_columns(std::string_view line, std::vector<FileFault>& faults) {
  Cells cells(line);
  while (!cells.at_end()) {
    const std::string_view cell = cells.next();
    if (cells.is_malformed()) {
      faults.push_back({name_, header_line_, cells.place(), "a quote is not closed", ""});
      return false;
    }
    columns_.push_back(column_of(cell, cells.place()));
  }
  targets_.resize(columns_.size());
  return true;
}

bool TrajectoryReader::check_columns(std::vector<FileFault>& faults) {
  const std::size_t before = faults.size();
  std::map<std::string_view, std::size_t> places;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].name.empty()) continue;
    const auto [first, is_new] = places.emplace(columns_[i].name, i);
    if (!is_new)
      faults.push_back(fault_at(
          i, fmt::format("a second column {}", in_backticks(columns_[i].name)),
          fmt::format("columns {} and {} have one name: rename one", first->second + 1, i + 1)));
  }
  const auto time = places.find("t");
  if (time == places.end()) {
    const bool is_one = columns_.size() == 1;
    faults.push_back({name_, header_line_, 1, "there is no column `t`",
                      is_one ? "the first line is the header, and commas separate its columns"
                             : "name the column of times `t [s]`"});
    return false;
  }
  time_column_ = time->second;
  const std::optional<std::string>& unit = columns_[time_column_].unit;
  if (!unit) {
    faults.push_back(fault_at(time_column_, "`t` has no unit", "write `t [s]`"));
    return false;
  }
  const Quantity factor = unit_factor(*unit, "s");
  if (factor.error.empty())
    bind(time_column_, factor.value, time_);
  else
    faults.push_back(fault_at(time_column_, factor.error, factor.hint));
  return faults.size() == before;
}

void TrajectoryReader::bind(std::size_t column, double factor, double& place) {
  targets_[column] = {&place, factor};
}

bool TrajectoryReader::next() {
  if (fault_) return false;
  std::optional<std::string_view> line = lines_.next();
  while (line && trimmed(*line).empty()) line = lines_.next();
  if (!line) {
    if (!lines_.error().empty())
      fault_ = FileFault{name_, lines_.number() + 1, 1, lines_.error(), ""};
    return false;
  }
  earlier_ = time_;
  if (!read_cells(*line) || !check_time()) return false;
  ++samples_;
  return true;
}

bool TrajectoryReader::read_cells(std::string_view line) {
  Cells cells(line);
  std::size_t column = 0;
  for (; !cells.at_end(); ++column) {
    const std::string_view cell = cells.next();
    if (cells.is_malformed()) return fail(cells.place(), "a quote is not closed");
    if (column >= columns_.size()) continue;  // counted, for the message below
    if (!read_cell(column, cell, cells.place())) return false;
  }
  if (column == columns_.size()) return true;
  return fail(1,
              fmt::format("the line has {} cell{}, the header has {}", column,
                          column == 1 ? "" : "s", columns_.size()),
              lines_.is_ended() ? "" : "the file ends within this line: is it cut off?");
}

bool TrajectoryReader::read_cell(std::size_t column, std::string_view cell, std::size_t place) {
  const Target& target = targets_[column];
  if (target.place == nullptr) return true;
  const std::optional<double> value = number_in(cell);
  const std::string& name = columns_[column].name;
  if (!value)
    return fail(place,
                cell.empty() ? fmt::format("the cell of {} is empty", in_backticks(name))
                             : fmt::format("{} is no number, in the column {}", in_backticks(cell),
                                           in_backticks(name)),
                hint_for_cell(cell));
  *target.place = *value * target.factor;
  if (column == time_column_) time_place_ = place;
  if (std::isfinite(*target.place) || column == time_column_) return true;
  if (++not_finite_.count == 1) {
    not_finite_.line = lines_.number();
    not_finite_.column = name;
  }
  return true;
}

bool TrajectoryReader::check_time() {
  if (!std::isfinite(time_)) return fail(time_place_, "the time is not finite");
  if (samples_ == 0 || time_ > earlier_) return true;
  return fail(time_place_,
              fmt::format("the time {} s does not come after {} s, that of the sample before",
                          shortest(time_), shortest(earlier_)),
              "sort the samples by time, each time once");
}

bool TrajectoryReader::fail(std::size_t place, std::string message, std::string hint) {
  fault_ = FileFault{name_, lines_.number(), place, std::move(message), std::move(hint)};
  return false;
}

}  // namespace twincraft
