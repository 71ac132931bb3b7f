// What is drawn of a member, and how a spec says it. See campaign_members.h.
#include "compiler/spec/campaign_members.h"

#include <fmt/format.h>

#include <array>

#include "compiler/draws/normal.h"
#include "compiler/draws/solid.h"
#include "compiler/ir/number.h"

namespace twincraft {
namespace {

using Form = Place::Form;

constexpr std::array<const char*, 6> kTensorEntries{"xx", "yy", "zz", "xy", "xz", "yz"};

Matrix3d tensor_of(const std::vector<double>& rows) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
}

std::vector<double> entries_of(const Matrix3d& I) {
  return {I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)};
}

/// The drawn numbers of one place. `uniforms` begins with its own.
class DrawAt {
 public:
  DrawAt(const Place& place, const double* uniforms) : place_(place), uniforms_(uniforms) {}

  std::vector<double> operator()(const ScalarDraws& scalars) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < scalars.each.size(); ++i)
      values.push_back(draws::value_of(scalars.each[i], uniforms_[i]));
    return values;
  }
  std::vector<double> operator()(const ConeDraw& cone) const {
    const Eigen::Vector2d tilts(normal(0, cone.sigma), normal(1, cone.sigma));
    const Vector3d axis(place_.values[0], place_.values[1], place_.values[2]);
    const Vector3d drawn = draws::tilted(axis, tilts);
    return {drawn.x(), drawn.y(), drawn.z()};
  }
  std::vector<double> operator()(const RotationDraw& rotation) const {
    const Vector3d turn = turn_from(0, rotation.sigma);
    return {turn.x(), turn.y(), turn.z()};
  }
  std::vector<double> operator()(const InertiaDraw& inertia) const {
    Vector3d factors;
    for (int i = 0; i < 3; ++i) factors[i] = draws::lognormal_factor(inertia.sigma, uniforms_[i]);
    const Vector3d turn = inertia.tilt > 0.0 ? turn_from(3, inertia.tilt) : Vector3d::Zero();
    return entries_of(draws::spread(tensor_of(place_.values), factors, turn));
  }

 private:
  double normal(std::size_t i, double sigma) const {
    return sigma * draws::normal_quantile(uniforms_[i]);
  }
  Vector3d turn_from(std::size_t first, double sigma) const {
    return {normal(first, sigma), normal(first + 1, sigma), normal(first + 2, sigma)};
  }

  const Place& place_;
  const double* uniforms_;
};

std::string list_text(const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(shortest(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

/// The value of a place as one writes it. @param drawn  its numbers
std::string value_text(const Place& place, const std::vector<double>& drawn) {
  if (place.form == Form::kNumber) return shortest(drawn[0]);
  if (place.form == Form::kInertia)
    return fmt::format("[{}, {}, {}]", list_text({drawn[0], drawn[3], drawn[4]}),
                       list_text({drawn[3], drawn[1], drawn[5]}),
                       list_text({drawn[4], drawn[5], drawn[2]}));
  if (place.form != Form::kAttitude) return list_text(drawn);
  const std::vector<double>& q = place.values;
  const Quaterniond turned =
      Quaterniond(q[0], q[1], q[2], q[3]) * draws::rotation_of({drawn[0], drawn[1], drawn[2]});
  return fmt::format("{{quaternion: {}}}",
                     list_text({turned.w(), turned.x(), turned.y(), turned.z()}));
}

/// All uniform numbers of a member.
std::vector<double> uniforms_of(const CampaignMembers& members, std::size_t member) {
  std::vector<double> uniforms(members.columns);
  for (std::size_t i = 0; i < uniforms.size(); ++i)
    uniforms[i] = members.sampler->uniform(member, i);
  if (members.copula) members.copula->apply(uniforms);
  return uniforms;
}

}  // namespace

std::vector<std::string> suffixes_of(const Place& place) {
  std::vector<std::string> names;
  switch (place.form) {
    case Form::kNumber:
      return {""};
    case Form::kList:
      for (std::size_t i = 1; i <= place.values.size(); ++i) names.push_back(fmt::format(".{}", i));
      return names;
    case Form::kInertia:
      for (const char* entry : kTensorEntries) names.push_back(fmt::format(".{}", entry));
      return names;
    case Form::kVector:
    case Form::kDirection:
    case Form::kAttitude:
      return {".x", ".y", ".z"};
  }
  return names;
}

std::vector<double> nominal_numbers(const Place& place) {
  if (place.form == Form::kInertia) return entries_of(tensor_of(place.values));
  if (place.form == Form::kAttitude) return {0.0, 0.0, 0.0};  // not turned
  return place.values;
}

std::size_t columns_of(const Draw& draw) {
  struct Count {
    std::size_t operator()(const ScalarDraws& scalars) const { return scalars.each.size(); }
    std::size_t operator()(const ConeDraw&) const { return 2; }
    std::size_t operator()(const RotationDraw&) const { return 3; }
    std::size_t operator()(const InertiaDraw& inertia) const { return inertia.tilt > 0.0 ? 6 : 3; }
  };
  return std::visit(Count{}, draw);
}

std::vector<double> CampaignMembers::drawn(std::size_t member) const {
  const std::vector<double> uniforms = uniforms_of(*this, member);
  std::vector<double> numbers;
  for (const DrawnPlace& each : places) {
    const std::vector<double> own =
        std::visit(DrawAt(each.place, uniforms.data() + each.first_column), each.draw);
    numbers.insert(numbers.end(), own.begin(), own.end());
  }
  return numbers;
}

std::vector<std::string> CampaignMembers::settings(std::size_t member) const {
  const std::vector<double> numbers = drawn(member);
  std::vector<std::string> settings;
  auto begin = numbers.begin();
  for (const DrawnPlace& each : places) {
    const auto end = begin + static_cast<std::ptrdiff_t>(suffixes_of(each.place).size());
    settings.push_back(fmt::format("{}={}", each.place.path, value_text(each.place, {begin, end})));
    begin = end;
  }
  return settings;
}

}  // namespace twincraft
