// A trajectory as netCDF-4, for tools that want names, units and provenance with their numbers. The
// quantities are those of the CSV, vectors as one variable. Tested by
// tests/runtime/netcdf_test.cpp.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "runtime/study/results.h"

namespace twincraft {

/// False in a build without the library (TWINCRAFT_NETCDF=OFF).
bool has_netcdf();

/// A file that is written while its samples come. The bytes are a function of the arguments and the
/// samples alone.
class NetcdfFile {
 public:
  /// @param path  of a file that is replaced
  /// All throw std::runtime_error when the library fails, or there is none.
  NetcdfFile(const std::string& path, const Bundle& bundle, std::string_view engine,
             const Provenance& provenance);
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  void take(const Observation& sample);
  void close();

 private:
  class Contents;
  std::unique_ptr<Contents> contents_;
};

}  // namespace twincraft
