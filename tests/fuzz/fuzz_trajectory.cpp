// Any bytes are a trajectory whose times rise, or a fault with words that are safe to show.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <sstream>
#include <string>

#include "compiler/diag/terminal.h"
#include "runtime/delivery/trajectory_reader.h"
#include "tests/fuzz/claim.h"

using namespace twincraft;

namespace {

void check(const FileFault& fault) {
  fuzz::claim(!fault.message.empty());
  fuzz::claim((fault.line > 0) == (fault.column > 0));
  const std::string text = to_text(fault);
  fuzz::claim(for_terminal(text, false) == text);
}

void check_samples(TrajectoryReader& reader) {
  const std::size_t columns = reader.columns().size();
  std::vector<double> numbers(columns);
  for (std::size_t i = 0; i < columns; ++i)
    if (reader.columns()[i].name != "t") reader.bind(i, 1.0, numbers[i]);
  double last = -std::numeric_limits<double>::infinity();
  std::size_t samples = 0;
  for (; reader.next(); ++samples) {
    fuzz::claim(std::isfinite(reader.time()) && reader.time() > last);
    last = reader.time();
  }
  fuzz::claim(reader.samples() == samples);
  if (reader.fault()) check(*reader.fault());
  fuzz::claim(!reader.next());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in(std::string(reinterpret_cast<const char*>(data), size));
  TrajectoryReader reader("a.csv", in);
  std::vector<FileFault> faults;
  if (reader.read_header(faults)) {
    fuzz::claim(faults.empty());
    check_samples(reader);
    return 0;
  }
  fuzz::claim(!faults.empty());
  for (const FileFault& fault : faults) check(fault);
  return 0;
}
