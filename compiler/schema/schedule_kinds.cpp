// The kinds that say when: schedules and intervals. Tested by tests/compiler/kind_test.cpp.
#include <fmt/format.h>

#include <cmath>

#include "compiler/schema/own_kind.h"

namespace twincraft {
namespace {

/// What every value of a schedule must be.
struct Values {
  std::string si;
  std::string unit;  // see Listing
  Range range = Range::kAny;
};

std::optional<double> read_value(const Node& node, const Values& values, ReadContext& context) {
  const std::optional<double> value = read_quantity(node, values.si, values.unit, context);
  if (!value || !check_range(*value, values.range, node, context)) return std::nullopt;
  if (!check_magnitude(*value, values.range, node, context)) return std::nullopt;
  return value;
}

/// How to write a schedule of values in `si`.
std::string schedule_form(const std::string& si) {
  return fmt::format("write points in order of time: `[[0 s, 1 {}], [40 s, 0]]`", si);
}

/// One `[time, value]`.
std::optional<Schedule::Entry> read_point(const Node& node, const Values& values,
                                          ReadContext& context) {
  if (!check_list(node, context, 2, 2, "a point `[time, value]`", schedule_form(values.si)))
    return std::nullopt;
  ReadContext at_time = part_of(context, "time");
  ReadContext at_value = part_of(context, "value");
  const std::optional<double> time = read_quantity(node.items[0], "s", {}, at_time);
  const std::optional<double> value = read_value(node.items[1], values, at_value);
  if (!time || !value) return std::nullopt;
  return Schedule::Entry{*time, *value};
}

std::optional<Schedule> read_points(const Node& node, const Values& values, ReadContext& context) {
  if (!check_list(node, context, 1, kAnyCount, "a quantity or points `[[time, value], ..]`",
                  schedule_form(values.si)))
    return std::nullopt;
  Schedule schedule;
  bool complete = true;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    ReadContext at_item = item_of(context, i);
    const std::optional<Schedule::Entry> point = read_point(node.items[i], values, at_item);
    complete = complete && point;
    if (!complete) continue;
    if (i > 0 && point->time <= schedule.entries.back().time) {
      context.diagnostics
          .error(Code::kBadSchedule, node.items[i].items[0].span,
                 fmt::format("{} is at {} s, not after the point before it", at_item.where,
                             point->time))
          .with_note(node.items[i - 1].items[0].span, "the point before it is here");
      complete = false;
    }
    schedule.entries.push_back(*point);
  }
  if (!complete) return std::nullopt;
  return schedule;
}

std::optional<Schedule> read_schedule(const Node& node, const Values& values,
                                      ReadContext& context) {
  if (!node.is_scalar()) return read_points(node, values, context);
  const std::optional<double> value = read_value(node, values, context);
  if (!value) return std::nullopt;
  return Schedule::constant(*value);
}

/// Entry `which` of every point of the schedule: 0 for times, 1 for values.
void collect(const Node& schedule, std::size_t which, std::vector<const Node*>& entries) {
  if (schedule.is_scalar() && which == 1) entries.push_back(&schedule);
  if (!schedule.is_list()) return;
  for (const Node& point : schedule.items)
    if (point.is_list() && point.items.size() == 2) entries.push_back(&point.items[which]);
}

/// Times together and values together. @pre they have been read without a fault
void judge(const std::vector<const Node*>& schedules, const Values& values,
           const ReadContext& context) {
  std::vector<const Node*> all_times, all_values;
  for (const Node* schedule : schedules) {
    collect(*schedule, 0, all_times);
    collect(*schedule, 1, all_values);
  }
  judge_bare_numbers(all_times, "s", {}, context);
  if (values.unit.empty()) judge_bare_numbers(all_values, values.si, usual_of(values.si), context);
}

Json write_schedule(const Schedule& schedule) {
  if (schedule.entries.empty()) return 0.0;
  if (std::isinf(schedule.entries.front().time)) return schedule.entries.front().value;
  Json points = Json::array();
  for (const Schedule::Entry& entry : schedule.entries)
    points.push_back(Json::array({entry.time, entry.value}));
  return points;
}

std::optional<std::array<Schedule, 3>> read_schedule3(const Node& node, const std::string& si,
                                                      ReadContext& context) {
  if (is_section(node)) {
    report_wrong_type(node, context, "three components, each a quantity or a schedule",
                      fmt::format("write for example `[0, [[0 s, 1 {}], [40 s, 0]], 0]`", si));
    return std::nullopt;
  }
  const std::optional<Listing> listing = read_listing(node, si, context);
  if (!listing) return std::nullopt;
  const Node& list = *listing->list;
  if (!check_list(list, context, 3, 3, "three components")) return std::nullopt;
  std::array<Schedule, 3> components;
  bool complete = true;
  for (std::size_t i = 0; i < 3; ++i) {
    ReadContext at_item = item_of(context, i);
    std::optional<Schedule> component =
        read_schedule(list.items[i], {si, listing->unit, Range::kAny}, at_item);
    if (component) components[i] = std::move(*component);
    complete = complete && component;
  }
  if (!complete) return std::nullopt;
  judge({&list.items[0], &list.items[1], &list.items[2]}, {si, listing->unit, Range::kAny},
        context);
  return components;
}

std::optional<Schedule::Interval> read_interval(const Node& node, ReadContext& context) {
  if (!check_list(node, context, 2, 2, "an interval `[start, end]`")) return std::nullopt;
  ReadContext at_start = part_of(context, "start");
  ReadContext at_end = part_of(context, "end");
  const std::optional<double> start = read_quantity(node.items[0], "s", {}, at_start);
  const std::optional<double> end = read_quantity(node.items[1], "s", {}, at_end);
  if (!start || !end) return std::nullopt;
  if (*start < *end) return Schedule::Interval{*start, *end};
  context.diagnostics.error(
      Code::kBadInterval, node.items[1].span,
      fmt::format("{} ends at {} s, not after its start at {} s", context.where, *end, *start));
  return std::nullopt;
}

std::optional<std::vector<Schedule::Interval>> read_intervals(const Node& node,
                                                              ReadContext& context) {
  if (!check_list(node, context, 1, kAnyCount, "a list of intervals `[[start, end], ..]`",
                  "write for example `[[0 s, 10 s], [60 s, 70 s]]`"))
    return std::nullopt;
  std::vector<Schedule::Interval> intervals;
  bool complete = true;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    ReadContext at_item = item_of(context, i);
    const std::optional<Schedule::Interval> interval = read_interval(node.items[i], at_item);
    complete = complete && interval;
    if (!complete) continue;
    if (i > 0 && interval->start < intervals.back().end) {
      context.diagnostics
          .error(Code::kBadInterval, node.items[i].items[0].span,
                 fmt::format("{} starts at {} s, before the one before it ends", at_item.where,
                             interval->start))
          .with_note(node.items[i - 1].items[1].span, "the one before it ends here");
      complete = false;
    }
    intervals.push_back(*interval);
  }
  if (!complete) return std::nullopt;
  judge_bare_numbers(scalars_of(node), "s", {}, context);
  return intervals;
}

Json write_intervals(const std::vector<Schedule::Interval>& intervals) {
  Json list = Json::array();
  for (const Schedule::Interval& interval : intervals)
    list.push_back(Json::array({interval.start, interval.end}));
  return list;
}

Json pair_list_schema(const Json& first, const Json& second) {
  const Json pair = {
      {"type", "array"}, {"items", Json::array({first, second})}, {"minItems", 2}, {"maxItems", 2}};
  return list_schema(pair, 1, kAnyCount);
}

}  // namespace

Kind<Schedule> schedule(SiUnit si, Range range) {
  const Json value = quantity(si, range).schema();
  return own_kind<Schedule>({
      .text = fmt::format("quantity [{}]{} or schedule", si, range_text(range)),
      .schema = any_of(value, pair_list_schema(quantity("s").schema(), value)),
      .read = [values = Values{std::string(si), {}, range}](
                  const Node& node, ReadContext& context) -> std::optional<Schedule> {
        std::optional<Schedule> schedule = read_schedule(node, values, context);
        if (schedule) judge({&node}, values, context);
        return schedule;
      },
      .write = write_schedule,
      .numbers = {Numbers::Form::kScalar, std::string(si)},
  });
}

Kind<std::array<Schedule, 3>> schedule3(SiUnit si) {
  return own_kind<std::array<Schedule, 3>>({
      .text = fmt::format("three quantities [{}] or schedules", si),
      .schema = listing_schema(list_schema(schedule(si).schema(), 3, 3), si),
      .read = [unit = std::string(si)](
                  const Node& node,
                  ReadContext& context) { return read_schedule3(node, unit, context); },
      .write = [](const std::array<Schedule, 3>& components) -> Json {
        Json list = Json::array();
        for (const Schedule& component : components) list.push_back(write_schedule(component));
        return list;
      },
      .numbers = {Numbers::Form::kVector, std::string(si)},
  });
}

Kind<std::vector<Schedule::Interval>> intervals() {
  const Json time = quantity("s").schema();
  return own_kind<std::vector<Schedule::Interval>>({
      .text = "list of intervals [start, end] [s]",
      .schema = pair_list_schema(time, time),
      .read = read_intervals,
      .write = write_intervals,
  });
}

}  // namespace twincraft
