#include "runtime/report/campaign_netcdf.h"

#include <netcdf.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <mutex>

#include "runtime/report/netcdf_file.h"

namespace twincraft {
namespace {

using netcdf::check;

constexpr std::size_t kRowsPerChunk = 4096;
constexpr std::size_t kBytesPerCell = 16;  // the most: a text is a length and a pointer
constexpr std::size_t kTextsAtATime = 4096;

/// A file being made of a table.
class Columns {
 public:
  Columns(const std::string& path, const CampaignTable& table) : table_(table), file_(path) {
    member_ = file_.dimension("member", table.rows());
  }

  void write(const Provenance& provenance) {
    describe(provenance);
    define_all();
    check(nc_enddef(file_.id()));
    for (const auto& fill : fills_) fill();
    file_.close();
  }

 private:
  void describe(const Provenance& provenance) const {
    const auto put = [this](const char* name, const std::string& text) {
      file_.attribute(NC_GLOBAL, name, text);
    };
    put("Conventions", "CF-1.8");
    put("title", table_.header().name);
    put("spec_sha256", table_.header().spec_sha256);
    put("instructions", table_.header().instructions);
    netcdf::describe(file_, provenance);
  }

  int define(const std::string& name, int type, const std::string& words) const {
    int id = -1;
    check(nc_def_var(file_.id(), name.c_str(), type, 1, &member_, &id));
    if (const std::size_t rows = std::min(table_.rows(), kRowsPerChunk); rows > 0) {
      check(nc_def_var_chunking(file_.id(), id, NC_CHUNKED, &rows));
      // A chunk is written once, so two in memory are enough; by default there are sixteen
      // megabytes.
      check(nc_set_var_chunk_cache(file_.id(), id, 2 * rows * kBytesPerCell, 3, 1.0F));
      if (type != NC_STRING) check(nc_def_var_deflate(file_.id(), id, 1, 1, 1));
    }
    file_.attribute(id, "long_name", words);
    return id;
  }

  int define_numbers(const std::string& name, const std::string& unit, const std::string& words,
                     std::span<const double> values) {
    const int id = define(name, NC_DOUBLE, words);
    file_.attribute(id, "units", netcdf::as_product(unit));
    fills_.emplace_back(
        [this, id, values] { check(nc_put_var_double(file_.id(), id, values.data())); });
    return id;
  }

  void define_texts(const std::string& name, const std::string& words,
                    std::function<std::string(std::size_t row)> text) {
    const int id = define(name, NC_STRING, words);
    fills_.emplace_back([this, id, text = std::move(text)] { put_texts(id, text); });
  }

  void define_members() {
    const int id = define("member", NC_INT64, "number of the member");
    fills_.emplace_back([this, id] {
      const std::vector<long long> members(table_.members().begin(), table_.members().end());
      check(nc_put_var_longlong(file_.id(), id, members.data()));
    });
  }

  void define_all() {
    define_members();
    for (std::size_t i = 0; i < table_.header().drawn.size(); ++i) {
      const DrawnNumber& one = table_.header().drawn[i];
      const int id = define_numbers(one.name, one.unit, one.name, table_.drawn(i));
      file_.attribute(id, "distribution", one.distribution);
      file_.attribute(id, "nominal", one.nominal);
    }
    for (std::size_t i = 0; i < table_.header().outputs.size(); ++i) {
      const OutputColumn& one = table_.header().outputs[i];
      const int id = define_numbers(one.name, one.unit, one.meaning, table_.output(i));
      file_.attribute(id, "_FillValue", std::numeric_limits<double>::quiet_NaN());
      if (one.below) file_.attribute(id, "below", *one.below);
      if (one.above) file_.attribute(id, "above", *one.above);
    }
    define_texts("verdict", "verdict on the agreement of the engines", [this](std::size_t row) {
      return std::string(verdict_name(table_.verdict(row)));
    });
    define_texts("reason", "why the member is broken, stopped, failed or refused",
                 [this](std::size_t row) { return std::string(table_.reason(row)); });
    define_numbers("seconds", "s", "time that the member took", table_.seconds());
  }

  /// The library wants pointers, so there are few texts at a time.
  void put_texts(int id, const std::function<std::string(std::size_t row)>& text) const {
    std::vector<std::string> texts;
    std::vector<const char*> pointers;
    for (std::size_t first = 0; first < table_.rows(); first += kTextsAtATime) {
      const std::size_t count = std::min(kTextsAtATime, table_.rows() - first);
      texts.clear();
      pointers.clear();
      for (std::size_t i = 0; i < count; ++i) texts.push_back(text(first + i));
      for (const std::string& one : texts) pointers.push_back(one.c_str());
      check(nc_put_vara_string(file_.id(), id, &first, &count, pointers.data()));
    }
  }

  const CampaignTable& table_;
  netcdf::File file_;
  int member_ = -1;  // the dimension
  std::vector<std::function<void()>> fills_;
};

}  // namespace

void write_campaign_netcdf(const std::string& path, const CampaignTable& table,
                           const Provenance& provenance) {
  const std::scoped_lock lock(netcdf::library());
  Columns(path, table).write(provenance);
}

}  // namespace twincraft
