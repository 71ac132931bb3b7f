// See body.h. Tested by tests/compiler/body_test.cpp.
#include "compiler/components/body.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "compiler/components/physical.h"
#include "compiler/schema/own_kind.h"

namespace twincraft {
namespace {

using Circle = std::vector<const BodySpec*>;

constexpr std::size_t kLongestCircleNamed = 6;

Kind<JointType> joint_type(const std::vector<std::pair<std::string_view, JointType>>& words) {
  return one_of<JointType>(words);
}

const char* const kPosition = "Of the joint, in the parent's axes.";

const Table<JointSpec>& revolute_table() {
  static const Table<JointSpec> table{
      "revolute joint",
      "Turns the body about an axis; effort on it: torque - stiffness (angle - rest) - damping "
      "rate.",
      {
          required("type", &JointSpec::type, joint_type({{"revolute", JointType::kRevolute}}),
                   "Which sort of joint this is."),
          required("axis", &JointSpec::axis, direction(),
                   "In the body's own axes; positive angles turn by the right hand about it."),
          optional("position", &JointSpec::position, vector3("m"), kPosition),
          optional("stiffness", &JointSpec::stiffness, quantity("N m/rad", Range::kNotNegative),
                   "Of a torsional spring."),
          optional("damping", &JointSpec::damping, quantity("N m s/rad", Range::kNotNegative),
                   "Of a torsional damper."),
          optional("rest", &JointSpec::rest, quantity("rad"), "Angle at which the spring rests."),
          optional("angle", &JointSpec::coordinate, quantity("rad"), "Initial angle."),
          optional("rate", &JointSpec::rate, quantity("rad/s"), "Initial rate."),
          optional("torque", &JointSpec::effort, schedule("N m"),
                   "On the body about the axis; the parent feels the opposite."),
      }};
  return table;
}

const Table<JointSpec>& prismatic_table() {
  static const Table<JointSpec> table{
      "prismatic joint",
      "Moves the body along an axis; effort on it: force - stiffness (displacement - rest) - "
      "damping rate.",
      {
          required("type", &JointSpec::type, joint_type({{"prismatic", JointType::kPrismatic}}),
                   "Which sort of joint this is."),
          required("axis", &JointSpec::axis, direction(), "In the body's own axes."),
          optional("position", &JointSpec::position, vector3("m"), kPosition),
          optional("stiffness", &JointSpec::stiffness, quantity("N/m", Range::kNotNegative),
                   "Of a spring."),
          optional("damping", &JointSpec::damping, quantity("N s/m", Range::kNotNegative),
                   "Of a damper."),
          optional("rest", &JointSpec::rest, quantity("m"),
                   "Displacement at which the spring rests."),
          optional("displacement", &JointSpec::coordinate, quantity("m"), "Initial displacement."),
          optional("rate", &JointSpec::rate, quantity("m/s"), "Initial rate."),
          optional("force", &JointSpec::effort, schedule("N"),
                   "On the body along the axis; the parent feels the opposite."),
      }};
  return table;
}

const Table<JointSpec>& fixed_table() {
  static const Table<JointSpec> table{
      "fixed joint",
      "Holds the body: it has no coordinate.",
      {
          required("type", &JointSpec::type, joint_type({{"fixed", JointType::kFixed}}),
                   "Which sort of joint this is."),
          optional("position", &JointSpec::position, vector3("m"), kPosition),
      }};
  return table;
}

const Table<JointSpec>& table_of(JointType type) {
  switch (type) {
    case JointType::kRevolute:
      return revolute_table();
    case JointType::kPrismatic:
      return prismatic_table();
    case JointType::kFixed:
      break;
  }
  return fixed_table();
}

/// What decides which keys the joint has; a joint without is reported.
std::optional<JointType> read_type(const Node& joint, ReadContext& context) {
  const Kind<JointType> type = joint_type({{"revolute", JointType::kRevolute},
                                           {"prismatic", JointType::kPrismatic},
                                           {"fixed", JointType::kFixed}});
  if (!joint.is_map()) {
    report_wrong_type(joint, context, "a map", "it begins with `type`: " + type.text());
    return std::nullopt;
  }
  if (const Node* written = joint.find("type")) {
    ReadContext of_type = part_of(context, "`type`");
    return type.read(*written, of_type);
  }
  context.diagnostics
      .error(Code::kMissingKey, joint.span, fmt::format("`type` is missing in {}", context.where))
      .with_hint("add `type`: " + type.text());
  return std::nullopt;
}

/// The keys follow from `type`, so that those of another sort of joint are unknown ones.
Kind<JointSpec> joint() {
  const Kind<JointSpec> revolute = object(revolute_table());
  const Kind<JointSpec> prismatic = object(prismatic_table());
  const Kind<JointSpec> fixed = object(fixed_table());
  return own_kind<JointSpec>({
      .text = words_text({"revolute", "prismatic", "fixed"}, "or") + " joint",
      .schema = any_of(revolute.schema(), any_of(prismatic.schema(), fixed.schema())),
      .read = [](const Node& node, ReadContext& context) -> std::optional<JointSpec> {
        const std::optional<JointType> type = read_type(node, context);
        if (!type) return std::nullopt;
        return table_of(*type).read_inside(node, context);
      },
      .write = [](const JointSpec& spec) { return table_of(spec.type).write(spec); },
      .tables = joined(revolute.tables(), joined(prismatic.tables(), fixed.tables())),
  });
}

/// A body is turned from its parent, where the directions of an orbit mean nothing.
void check_orientation(const AttitudeSpec& orientation, const std::string& who,
                       Diagnostics& diagnostics) {
  const std::size_t errors_before = diagnostics.error_count();
  for (const AlignSpec& align : orientation.align) {
    if (!std::holds_alternative<OrbitDirection>(align.to)) continue;
    diagnostics
        .error(
            Code::kAlignImpossible, align.span_of("to"),
            fmt::format("{} is turned from its parent, which knows no direction of an orbit", who))
        .with_hint("give a vector in the parent's axes");
  }
  if (diagnostics.error_count() == errors_before) check(orientation, nullptr, diagnostics);
}

void report_circle(const Circle& circle, Diagnostics& diagnostics) {
  const BodySpec& first = *circle.front();
  std::vector<std::string> others;
  for (const BodySpec* body : circle) {
    if (body != &first) others.push_back(body->name);
  }
  std::string message = fmt::format("body `{}` is its own parent", first.name);
  if (others.size() > kLongestCircleNamed) {
    message =
        fmt::format("body `{}` hangs on itself by way of {} others", first.name, others.size());
  } else if (!others.empty()) {
    message = fmt::format("body `{}` hangs on itself by way of {}", first.name,
                          words_text(others, "and"));
  }
  diagnostics.error(Code::kParentCircle, first.span_of("parent"), message)
      .with_hint("one of the circle must hang on `hub` or on a body outside");
}

/// Body to parent components at zero coordinate.
Matrix3d turn_of(const BodySpec& body) {
  if (!body.orientation) return Matrix3d::Identity();
  return orientation(*body.orientation, PointState{}).toRotationMatrix();
}

Joint joint_of(const BodySpec& body) {
  Joint joint;
  joint.kind = body.joint.type == JointType::kPrismatic ? JointKind::kSlide : JointKind::kHinge;
  joint.r_HP_P = body.joint.position;
  joint.dcm_PL0 = turn_of(body);
  joint.axis_L = body.joint.axis;
  joint.stiffness = body.joint.stiffness;
  joint.damping = body.joint.damping;
  joint.rest = body.joint.rest;
  joint.effort = body.joint.effort;
  return joint;
}

}  // namespace

const Table<BodySpec>& body_table() {
  static const Table<BodySpec> table{
      "body",
      "A rigid body on a joint. Bodies form chains and branches from the hub on and may be written "
      "in any order; wheels, panels and loads can be mounted on them.",
      {
          required("name", &BodySpec::name, name(), "Unique in the file."),
          optional("parent", &BodySpec::parent, reference_to("body"), "What carries the body."),
          required("joint", &BodySpec::joint, joint(), "What joins it to its parent."),
          optional("orientation", &BodySpec::orientation, maybe(object(attitude_table())),
                   "How the body is turned from its parent when its joint is at zero, in any form "
                   "of an attitude: B is the body, N the parent. Default not at all."),
          required("mass", &BodySpec::mass, quantity("kg", Range::kPositive),
                   "Without what is mounted on it."),
          optional("center_of_mass", &BodySpec::center_of_mass, vector3("m"),
                   "From the joint, in the body's axes."),
          required("inertia", &BodySpec::inertia, inertia(),
                   "About its own centre of mass, in the body's axes."),
      }};
  return table;
}

bool is_fixed(const BodySpec& body) { return body.joint.type == JointType::kFixed; }

void check(const BodySpec& body, const Context& context, Diagnostics& diagnostics) {
  const std::string who = fmt::format("body `{}`", body.name);
  check_mount(body.parent, body.span_of("parent"), who, context.names, diagnostics);
  if (body.orientation) check_orientation(*body.orientation, who, diagnostics);
  check_mass(body.mass, body.span_of("mass"), who, diagnostics);
  check_inertia(body.inertia, body.span_of("inertia"), who, diagnostics);
}

void check_together(const std::vector<BodySpec>& bodies, const Context&, Diagnostics& diagnostics) {
  std::map<std::string, const BodySpec*> by_name;
  for (const BodySpec& body : bodies) by_name.emplace(body.name, &body);
  std::set<const BodySpec*> walked;
  for (const BodySpec& body : bodies) {
    Circle path;
    const BodySpec* next = &body;
    while (next != nullptr && walked.insert(next).second) {
      path.push_back(next);
      const auto parent = by_name.find(next->parent);
      next = parent == by_name.end() ? nullptr : parent->second;
    }
    // A path that ends at the hub, or at what an earlier one has walked, closes no circle.
    const auto entry = std::find(path.begin(), path.end(), next);
    if (entry != path.end()) report_circle(Circle(entry, path.end()), diagnostics);
  }
}

namespace {

/// Parents before children and a branch in one piece, otherwise as written.
std::vector<const BodySpec*> parents_first(const std::vector<BodySpec>& bodies) {
  std::map<std::string, std::vector<const BodySpec*>> children;  // last written first
  for (auto body = bodies.rbegin(); body != bodies.rend(); ++body) {
    children[body->parent].push_back(&*body);
  }
  std::vector<const BodySpec*> order;
  std::vector<const BodySpec*> waiting = children["hub"];
  while (!waiting.empty()) {
    const BodySpec* body = waiting.back();
    waiting.pop_back();
    order.push_back(body);
    const auto& on_it = children[body->name];
    waiting.insert(waiting.end(), on_it.begin(), on_it.end());
  }
  return order;
}

void lower_mount(const BodySpec& body, ModelBuilder& builder) {
  const Mount parent = builder.find_mount(body.parent);
  const Mount mount =
      is_fixed(body) ? builder.add_fixed_body(parent, body.name, body.joint.position, turn_of(body))
                     : builder.add_link(parent, body.name, joint_of(body));
  builder.add_mass(mount, {body.name, body.mass, body.center_of_mass, body.inertia});
}

}  // namespace

void lower_mounts(const std::vector<BodySpec>& bodies, ModelBuilder& builder) {
  for (const BodySpec* body : parents_first(bodies)) lower_mount(*body, builder);
}

void lower(const BodySpec& body, const Vehicle&, ModelBuilder& builder) {
  if (is_fixed(body)) return;
  const bool slides = body.joint.type == JointType::kPrismatic;
  builder.add_coordinate(
      slides ? Coordinate::Kind::kBodyDisplacement : Coordinate::Kind::kBodyAngle, body.name,
      builder.find_mount(body.name).link, body.joint.coordinate, body.joint.rate);
}

Coordinates coordinates_of(const BodySpec& body) { return {1, body.span_of("name")}; }

double mass_of(const BodySpec& body) { return body.mass; }

}  // namespace twincraft
