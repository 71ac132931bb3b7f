#include "runtime/campaign/records.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "twincraft-campaign/";
constexpr std::string_view kVersion = "1";
constexpr std::size_t kBlock = std::size_t{1} << 16U;  // bytes that are read at a time
constexpr std::size_t kLongestLine = std::size_t{1}
                                     << 24U;  // bytes; a longer one is no line of ours
constexpr std::string_view kForeign = "it holds no results of a campaign";
constexpr std::string_view kDamagedHeader = "its header is damaged";

/// CRC-32C (Castagnoli): any burst of up to 32 bits is found.
std::string checksum(std::string_view text) {
  boost::crc_optimal<32, 0x1EDC6F41, 0xFFFFFFFF, 0xFFFFFFFF, true, true> crc;
  crc.process_bytes(text.data(), text.size());
  return fmt::format("{:08x}", crc.checksum());
}

/// What a line says when its checksum is right.
std::optional<std::string_view> checked(std::string_view line) {
  constexpr std::size_t kDigits = 8;
  if (line.size() <= kDigits || line[kDigits] != ' ') return std::nullopt;
  const std::string_view text = line.substr(kDigits + 1);
  if (line.substr(0, kDigits) != checksum(text)) return std::nullopt;
  return text;
}

// What is not in a line, and how it is written in one.
constexpr std::array<std::pair<char, char>, 4> kEscapes{
    {{'\\', '\\'}, {'\t', 't'}, {'\n', 'n'}, {'\r', 'r'}}};

std::string escaped(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const auto* escape = std::ranges::find(kEscapes, c, &std::pair<char, char>::first);
    if (escape != kEscapes.end()) line += '\\';
    line += escape != kEscapes.end() ? escape->second : c;
  }
  return line;
}

std::optional<std::string> unescaped(std::string_view line) {
  std::string text;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '\\') {
      text += line[i];
      continue;
    }
    if (++i == line.size()) return std::nullopt;
    const auto* escape = std::ranges::find(kEscapes, line[i], &std::pair<char, char>::second);
    if (escape == kEscapes.end()) return std::nullopt;
    text += escape->first;
  }
  return text;
}

template <class Number>
bool read_number(std::string_view text, Number& number) {
  const auto [stop, fault] = std::from_chars(text.begin(), text.end(), number);
  return fault == std::errc() && stop == text.end();
}

bool read_finite(std::string_view text, double& number) {
  return read_number(text, number) && std::isfinite(number);
}

bool read_verdict(std::string_view name, Verdict& verdict) {
  for (const Verdict one : {Verdict::kAgree, Verdict::kDisagree, Verdict::kUnresolved,
                            Verdict::kNotJudged, Verdict::kFailed, Verdict::kInterrupted})
    if (verdict_name(one) == name) {
      verdict = one;
      return true;
    }
  return false;
}

/// The cells of a line, one after another.
class Cells {
 public:
  explicit Cells(std::string_view line) : rest_(line) {}

  std::string_view next() {
    const std::size_t end = std::min(rest_.find('\t'), rest_.size());
    const std::string_view cell = rest_.substr(0, end);
    is_over_ = end == rest_.size();
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    return cell;
  }
  bool is_over() const { return is_over_; }  // the last one was given

 private:
  std::string_view rest_;
  bool is_over_ = false;
};

bool read_cells(Cells& cells, const RecordsHeader& header, MemberRecord& record) {
  record.drawn.assign(header.drawn.size(), 0.0);
  for (double& number : record.drawn)
    if (!read_finite(cells.next(), number)) return false;
  record.outputs.assign(header.outputs.size(), std::nullopt);
  for (std::optional<double>& number : record.outputs)
    if (const std::string_view cell = cells.next();
        !cell.empty() && !read_finite(cell, number.emplace()))
      return false;
  if (!read_verdict(cells.next(), record.verdict)) return false;
  record.twin.reset();
  if (const std::string_view twin = cells.next();
      !twin.empty() && !read_verdict(twin, record.twin.emplace()))
    return false;
  if (!read_finite(cells.next(), record.seconds) || cells.is_over()) return false;
  const std::optional<std::string> reason = unescaped(cells.next());
  record.reason = reason.value_or("");
  return reason && cells.is_over();
}

Json bound(const std::optional<double>& value) { return value ? Json(*value) : Json(); }
std::optional<double> bound(const Json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

Json to_json(const RecordsHeader& header) {
  Json drawn = Json::array(), outputs = Json::array();
  for (const DrawnNumber& one : header.drawn)
    drawn.push_back({{"name", one.name},
                     {"unit", one.unit},
                     {"distribution", one.distribution},
                     {"nominal", one.nominal}});
  for (const OutputColumn& one : header.outputs)
    outputs.push_back({{"name", one.name},
                       {"unit", one.unit},
                       {"meaning", one.meaning},
                       {"below", bound(one.below)},
                       {"above", bound(one.above)}});
  return {{"name", header.name},
          {"spec_sha256", header.spec_sha256},
          {"instructions", header.instructions},
          {"drawn", std::move(drawn)},
          {"outputs", std::move(outputs)}};
}

/// @throws nlohmann::json::exception
RecordsHeader from_json(const Json& json) {
  RecordsHeader header;
  json.at("name").get_to(header.name);
  json.at("spec_sha256").get_to(header.spec_sha256);
  json.at("instructions").get_to(header.instructions);
  for (const Json& one : json.at("drawn"))
    header.drawn.push_back(
        {one.at("name"), one.at("unit"), one.at("distribution"), one.at("nominal")});
  for (const Json& one : json.at("outputs"))
    header.outputs.push_back({one.at("name"), one.at("unit"), one.at("meaning"),
                              bound(one.at("below")), bound(one.at("above"))});
  return header;
}

std::optional<RecordsHeader> parse_header(std::string_view line) {
  const std::optional<std::string_view> text = checked(line);
  if (!text) return std::nullopt;
  try {
    return from_json(Json::parse(*text));
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

std::string difference(const RecordsHeader& one, const RecordsHeader& other) {
  if (one.spec_sha256 != other.spec_sha256) return "they are results of another spec";
  const auto is_same = [](const DrawnNumber& a, const DrawnNumber& b) {
    return a.name == b.name && a.unit == b.unit;
  };
  if (!std::ranges::equal(one.drawn, other.drawn, is_same) || one.outputs != other.outputs)
    return "they have other columns";
  return {};
}

std::string checked_line(std::string_view text) {
  return fmt::format("{} {}\n", checksum(text), text);
}

std::string header_json(const RecordsHeader& header) {
  return to_json(header).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string header_line(const RecordsHeader& header) {
  return fmt::format("{}{} {}", kFormat, kVersion, checked_line(header_json(header)));
}

std::string members_line(std::size_t members) {
  return checked_line(fmt::format("members\t{}", members));
}

std::string record_line(const MemberRecord& record) {
  std::string text = std::to_string(record.member);
  const auto add = [&text](std::string_view cell) {
    text += '\t';
    text += cell;
  };
  for (const double number : record.drawn) add(shortest(number));
  for (const std::optional<double>& number : record.outputs) add(number ? shortest(*number) : "");
  add(verdict_name(record.verdict));
  add(record.twin ? verdict_name(*record.twin) : "");
  add(shortest(record.seconds));
  add(escaped(record.reason));
  return checked_line(text);
}

RecordReader::RecordReader(std::istream& in) : in_(in) { error_ = read_header(); }

bool RecordReader::fill() {
  buffer_.erase(0, begin_);
  begin_ = 0;
  const std::size_t held = buffer_.size();
  buffer_.resize(held + kBlock);
  in_.read(buffer_.data() + held, static_cast<std::streamsize>(kBlock));
  const auto read = static_cast<std::size_t>(in_.gcount());
  buffer_.resize(held + read);
  return read > 0;
}

std::optional<std::string_view> RecordReader::next_line() {
  for (std::size_t searched = 0; searched <= kLongestLine;) {
    const std::size_t end = buffer_.find('\n', begin_ + searched);
    if (end != std::string::npos) {
      const std::string_view line = std::string_view(buffer_).substr(begin_, end - begin_);
      begin_ = end + 1;
      return line;
    }
    searched = left();
    if (!fill()) break;
  }
  return std::nullopt;
}

/// Of a file that ends in its first line.
std::string RecordReader::foreign_start() const {
  if (in_.bad()) return "it cannot be read";
  const std::string ours = fmt::format("{}{} ", kFormat, kVersion);
  const std::string_view start = std::string_view(buffer_).substr(begin_, ours.size());
  return std::string_view(ours).starts_with(start) ? std::string() : std::string(kForeign);
}

std::string RecordReader::read_header() {
  const std::optional<std::string_view> line = next_line();
  if (!line) return foreign_start();
  if (!line->starts_with(kFormat)) return std::string(kForeign);
  const std::string_view text = line->substr(kFormat.size());
  const std::size_t space = std::min(text.find(' '), text.size());
  if (text.substr(0, space) != kVersion)
    return fmt::format("another version wrote it: its format is {}{}, not {}{}", kFormat,
                       text.substr(0, std::min(space, std::size_t{20})), kFormat, kVersion);
  header_ = parse_header(text.substr(std::min(space + 1, text.size())));
  if (!header_) return std::string(kDamagedHeader);
  whole_bytes_ = line->size() + 1;
  return {};
}

RecordReader::Line RecordReader::read_line(std::string_view line, MemberRecord& record) {
  const std::optional<std::string_view> text = checked(line);
  if (!text) return Line::kDamaged;
  Cells cells(*text);
  const std::string_view first = cells.next();
  if (first == "members") {
    std::size_t members = 0;
    if (!read_number(cells.next(), members) || !cells.is_over()) return Line::kDamaged;
    members_ = members;
    return Line::kMembers;
  }
  const bool is_whole = read_number(first, record.member) && read_cells(cells, *header_, record);
  return is_whole ? Line::kRecord : Line::kDamaged;
}

bool RecordReader::next(MemberRecord& record) {
  if (!header_ || !tail_.empty()) return false;
  while (const std::optional<std::string_view> line = next_line()) {
    const Line kind = read_line(*line, record);
    if (kind == Line::kDamaged) {
      tail_ = fmt::format("record {} is damaged", records_ + 1);
      return false;
    }
    whole_bytes_ += line->size() + 1;
    if (kind == Line::kMembers) continue;
    ++records_;
    return true;
  }
  if (in_.bad())
    tail_ = "it cannot be read to its end";
  else if (left() > 0)
    tail_ = fmt::format("record {} is cut off", records_ + 1);
  return false;
}

}  // namespace twincraft
