#include "dem/grips/grip_face.h"

#include "base/errors.h"

#include <Eigen/Eigenvalues>

namespace dem
{
  std::vector<Eigen::Vector2d>
  arms_in_face(const std::vector<Eigen::Vector3d> &places, const int axis, const int dimension)
  {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d &place : places)
      middle += place / static_cast<double>(places.size());
    std::vector<Eigen::Vector2d> arms;
    Eigen::Matrix2d              second = Eigen::Matrix2d::Zero(); // moments of area
    for (const Eigen::Vector3d &place : places)
      {
        Eigen::Vector2d arm;
        for (int c = 0; c < 2; ++c)
          arm[c] = dimension == 2 && across(axis, c) == 2 ? 0.0 : place[across(axis, c)] - middle[across(axis, c)];
        second += arm * arm.transpose();
        arms.push_back(arm);
      }
    const Eigen::Vector2d spread   = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(second).eigenvalues(); // ascending
    constexpr double      rounding = 1e-12;
    if (!(spread[1] > 0) || (dimension == 3 && !(spread[0] > rounding * spread[1])))
      throw base::InputError("grips that turn: the particles of one of them lie on a line, and have no face that "
                             "could. Widen Grip thickness, or keep the grips parallel.");
    return arms;
  }
} // namespace dem
