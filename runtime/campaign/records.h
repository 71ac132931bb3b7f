// The results of a campaign as they come: a file that grows by one line per member, so that a kill
// at any byte loses the member being written and no other.
//
// It is text. Numbers are the shortest that read back to the bit, a line ends where a line ends,
// and what is in it can be looked at; binary would be half as long and nothing else. Every line but
// the header begins with the CRC-32C of the rest of it:
//
//     twincraft-campaign/1 CRC {"name": .., "spec_sha256": .., "instructions": ..,
//                               "drawn": [..], "outputs": [..]}          (one line)
//     CRC members <tab> 1024
//     CRC 17 <tab> drawn .. <tab> output .. <tab> verdict <tab> twin <tab> seconds <tab> reason
//
// What is read may be anybody's: no more than one line of it is in memory, and what is wrong is
// said in words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/ir/campaign.h"
#include "runtime/campaign/requirements.h"
#include "runtime/compare/verdict.h"

namespace twincraft {

/// What all members of a file have in common.
struct RecordsHeader {
  std::string name;          // of the vehicle
  std::string spec_sha256;   // of the spec without campaign.members
  std::string instructions;  // the set that the analytic engine flew with
  std::vector<DrawnNumber> drawn;
  std::vector<OutputColumn> outputs;
};
/// Empty: members of both may be in one table. Else why not: `results of another spec`. The set of
/// instructions may differ; last digits then do.
std::string difference(const RecordsHeader& one, const RecordsHeader& other);

/// What a member leaves.
struct MemberRecord {
  std::size_t member = 0;
  std::vector<double> drawn;                   // SI, finite, one per column
  std::vector<std::optional<double>> outputs;  // the same; nothing: none, or never reached
  Verdict verdict = Verdict::kNotJudged;
  std::optional<Verdict> twin;  // where both engines flew
  double seconds = 0.0;         // that it took
  std::string reason;           // one line: why it is broken, stopped, failed or refused

  bool operator==(const MemberRecord&) const = default;
};

/// As the header's line has it, JSON.
std::string header_json(const RecordsHeader& header);

/// The lines of a file, each with its end.
std::string header_line(const RecordsHeader& header);
/// How many members the campaign has from now on. A file has it after its header, and again where
/// the campaign goes on with another number.
std::string members_line(std::size_t members);
/// @pre numbers are finite, and as many as the header has columns
std::string record_line(const MemberRecord& record);

/// Any line but the header: a checksum and a text that has no line end.
std::string checked_line(std::string_view text);

class RecordReader {
 public:
  /// Reads the header. @param in  outlives the reader
  explicit RecordReader(std::istream& in);

  /// Why nothing of the file may be used, or be written over; empty: nothing speaks against it.
  const std::string& error() const { return error_; }
  /// Nothing: the file ends before its header does; all of it may be written anew.
  const std::optional<RecordsHeader>& header() const { return header_; }

  /// The next whole record. @return false at the end of those
  bool next(MemberRecord& record);

  /// As far as it is read:
  std::optional<std::size_t> members() const { return members_; }  // the campaign has
  /// Up to here all is whole: a file is cut off here before it is written on.
  std::uintmax_t whole_bytes() const { return whole_bytes_; }
  /// After the last next(): empty, or why the bytes from there on are not read: `record 18 is cut
  /// off`, `record 18 is damaged`.
  const std::string& tail() const { return tail_; }

 private:
  /// Without its end; nothing: what is left in `buffer_` is no whole line.
  std::optional<std::string_view> next_line();
  bool fill();
  std::size_t left() const { return buffer_.size() - begin_; }  // bytes that are no line
  enum class Line { kMembers, kRecord, kDamaged };
  Line read_line(std::string_view line, MemberRecord& record);
  std::string read_header();
  std::string foreign_start() const;

  std::istream& in_;
  std::string buffer_;
  std::size_t begin_ = 0;  // of what has not been given, in `buffer_`
  std::string error_, tail_;
  std::optional<RecordsHeader> header_;
  std::optional<std::size_t> members_;
  std::size_t records_ = 0;
  std::uintmax_t whole_bytes_ = 0;
};

}  // namespace twincraft
