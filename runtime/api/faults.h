// What can go wrong for a caller of the library, as exceptions inside it: each with the status that
// the C interface returns for it.
#pragma once

#include <stdexcept>
#include <string>

#include "runtime/api/include/twincraft.h"

namespace twincraft::api {

class Fault : public std::runtime_error {
 public:
  Fault(tc_status status, const std::string& what) : std::runtime_error(what), status_(status) {}
  tc_status status() const { return status_; }

 private:
  tc_status status_;
};

/// An unknown name; a value that is not finite, or of another size or unit; a time that is over.
[[noreturn]] inline void refuse(const std::string& what) { throw Fault(TC_USAGE, what); }

}  // namespace twincraft::api
