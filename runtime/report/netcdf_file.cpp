#include "runtime/report/netcdf_file.h"

#include <fmt/format.h>
#include <netcdf.h>

#include <algorithm>
#include <stdexcept>

namespace twincraft::netcdf {

void check(int status) {
  if (status != NC_NOERR) throw std::runtime_error(fmt::format("netcdf: {}", nc_strerror(status)));
}

std::mutex& library() {
  static std::mutex mutex;
  return mutex;
}

std::string as_product(const std::string& unit) {
  const std::size_t slash = unit.find('/');
  if (slash == std::string::npos) return unit;
  const std::size_t end = std::min(unit.find_first_of(" /", slash + 1), unit.size());
  std::string divisor = unit.substr(slash + 1, end - slash - 1);
  const std::size_t digit = std::min(divisor.find_first_of("0123456789"), divisor.size());
  divisor.insert(digit, digit < divisor.size() ? "-" : "-1");
  return as_product(fmt::format("{} {}{}", unit.substr(0, slash), divisor, unit.substr(end)));
}

File::File(const std::string& path) { check(nc_create(path.c_str(), NC_NETCDF4, &id_)); }

File::~File() {
  if (open_) nc_abort(id_);
}

int File::dimension(const char* name, std::size_t length) const {
  int dimension = -1;
  check(nc_def_dim(id_, name, length, &dimension));
  return dimension;
}

void File::attribute(int variable, const char* name, const std::string& text) const {
  check(nc_put_att_text(id_, variable, name, text.size(), text.data()));
}

void File::attribute(int variable, const char* name, double number) const {
  check(nc_put_att_double(id_, variable, name, NC_DOUBLE, 1, &number));
}

void File::close() {
  open_ = false;
  check(nc_close(id_));
}

void describe(const File& file, const Provenance& provenance) {
  const auto put = [&](const char* name, const std::string& text) {
    file.attribute(NC_GLOBAL, name, text);
  };
  put("source", provenance.program);
  put("git", provenance.git);
  put("compiler", provenance.compiler);
  put("compiler_flags", provenance.flags);
  put("mujoco", provenance.mujoco);
  put("eigen", provenance.eigen);
}

}  // namespace twincraft::netcdf
