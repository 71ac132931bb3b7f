// Vectors and matrices as JSON has them: a list, and a list of rows.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace twincraft {

inline nlohmann::ordered_json vector_json(const Eigen::Vector3d& vector) {
  return nlohmann::ordered_json::array({vector.x(), vector.y(), vector.z()});
}

inline nlohmann::ordered_json matrix_json(const Eigen::Matrix3d& matrix) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const auto& row : matrix.rowwise()) rows.push_back(vector_json(row.transpose()));
  return rows;
}

}  // namespace twincraft
