// What Twincraft throws: an exception derived from Error for each way in which a call of the C
// interface can fail.
#ifndef TWINCRAFT_ERROR_H
#define TWINCRAFT_ERROR_H

#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "../twincraft.h"

namespace twincraft {

/// What went wrong, in the words that the programs print.
class Error : public std::runtime_error {
 public:
  Error(tc_status status, const std::string& what) : std::runtime_error(what), status_(status) {}
  tc_status status() const { return status_; }

 private:
  tc_status status_;
};

/// The spec has errors: where, what, why.
class SpecError : public Error {
 public:
  SpecError(const std::string& what, std::string diagnostics)
      : Error(TC_SPEC, what), diagnostics_(std::move(diagnostics)) {}
  /// The document of `--diagnostics json`.
  const std::string& diagnostics() const { return diagnostics_; }

 private:
  std::string diagnostics_;
};

/// An unknown name, a value that is not finite or of another size or unit, a time that is over.
class UsageError : public Error {
 public:
  explicit UsageError(const std::string& what) : Error(TC_USAGE, what) {}
};

/// A file cannot be read or written.
class FileError : public Error {
 public:
  explicit FileError(const std::string& what) : Error(TC_FILE, what) {}
};

/// The motion is no longer finite. The simulation stands at its last good step end.
class NumericalFailure : public Error {
 public:
  NumericalFailure(const std::string& what, double time, std::string coordinate)
      : Error(TC_NUMERICAL, what), time_(time), coordinate_(std::move(coordinate)) {}
  double time() const { return time_; }  // [s] of that step end
  const std::string& coordinate() const { return coordinate_; }

 private:
  double time_;
  std::string coordinate_;
};

/// Bytes of another vehicle, engine or version, or damaged.
class SnapshotError : public Error {
 public:
  explicit SnapshotError(const std::string& what) : Error(TC_SNAPSHOT, what) {}
};

/// In use by another thread.
class BusyError : public Error {
 public:
  BusyError() : Error(TC_BUSY, "it is in use by another thread") {}
};

/// A poll said so. Everything is usable.
class Interrupted : public Error {
 public:
  Interrupted() : Error(TC_INTERRUPTED, "interrupted") {}
};

namespace detail {

inline void check(tc_status status, const char* error) {
  switch (status) {
    case TC_OK:
      return;
    case TC_USAGE:
      throw UsageError(error);
    case TC_FILE:
      throw FileError(error);
    case TC_NUMERICAL:
      throw NumericalFailure(error, 0.0, "");
    case TC_SNAPSHOT:
      throw SnapshotError(error);
    case TC_BUSY:
      throw BusyError();
    case TC_MEMORY:
      throw std::bad_alloc();
    case TC_INTERRUPTED:
      throw Interrupted();
    default:
      throw Error(status, error);
  }
}

}  // namespace detail
}  // namespace twincraft

#endif
