// See dot.h. Names are identifiers by the language's own rule, so nothing needs escaping.
// Tested by tests/compiler/emit_test.cpp.
#include "compiler/emit/dot.h"

#include <fmt/format.h>

#include <iterator>

#include "compiler/ir/number.h"

namespace twincraft {
namespace {

double mass_on(const Link& link) {
  double mass = 0.0;
  for (const MassElement& element : link.elements) mass += element.mass;
  return mass;
}

const char* kind_word(JointKind kind) { return kind == JointKind::kHinge ? "hinge" : "slide"; }

void draw_assembly(const Assembly& assembly, std::string& out) {
  auto line = std::back_inserter(out);
  fmt::format_to(line, "  subgraph cluster_assembly {{\n    label=\"effector assembly\";\n");
  for (std::size_t i = 0; i < assembly.links.size(); ++i) {
    const Link& link = assembly.links[i];
    fmt::format_to(line, "    link{} [label=\"{}\\n{} kg\"];\n", i, link.name,
                   shortest(mass_on(link)));
    if (link.parent < 0) continue;
    fmt::format_to(line, "    link{} -> link{} [label=\"{}\"];\n", link.parent, i,
                   kind_word(link.joint.kind));
  }
  for (std::size_t i = 0; i < assembly.rotors.size(); ++i) {
    const Rotor& rotor = assembly.rotors[i];
    fmt::format_to(line, "    rotor{} [label=\"{}\\n{} kg m2\", shape=ellipse];\n", i, rotor.name,
                   shortest(rotor.spin_inertia));
    fmt::format_to(line, "    link{} -> rotor{} [label=\"rotor\"];\n", rotor.link, i);
  }
  out += "  }\n";
}

void draw_tree(const BodyTree& tree, std::string& out) {
  auto line = std::back_inserter(out);
  fmt::format_to(line, "  subgraph cluster_tree {{\n    label=\"body tree\";\n");
  for (std::size_t i = 0; i < tree.bodies.size(); ++i) {
    const TreeBody& body = tree.bodies[i];
    fmt::format_to(line, "    body{} [label=\"{}\\n{} kg\"];\n", i, body.name,
                   shortest(body.inertial.mass));
    if (body.parent < 0) continue;
    const char* word = body.joints.empty() ? "welded" : kind_word(body.joints.front().kind);
    fmt::format_to(line, "    body{} -> body{} [label=\"{}\"];\n", body.parent, i, word);
  }
  out += "  }\n";
}

}  // namespace

std::string emit_dot(const Model& model) {
  std::string out = fmt::format(
      "digraph \"{}\" {{\n  rankdir=TB;\n  node [shape=box, fontname=\"sans-serif\"];\n"
      "  edge [fontname=\"sans-serif\", fontsize=10];\n",
      model.name);
  draw_assembly(model.assembly, out);
  draw_tree(model.tree, out);
  for (std::size_t i = 0; i < model.tree.bodies.size(); ++i) {
    const int link = model.tree.bodies[i].link;
    if (link < 0) continue;
    fmt::format_to(std::back_inserter(out),
                   "  link{} -> body{} [style=dotted, dir=none, constraint=false];\n", link, i);
  }
  return out + "}\n";
}

}  // namespace twincraft
