#pragma once

#include "base/state.h"
#include "dem/laboratory/hull.h"
#include "dem/specimen/specimen.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace dem
{
  /** Two planes across an axis between which a specimen stands. */
  struct EndPlanes
  {
    int    axis = 2;
    double low = 0, high = 0; ///< along it [m]
  };

  /**
   * A flexible membrane around a specimen between two platens: pressure on the facets of its hull, shared alike by their corners. Facets
   * whose corners all lie at a platen are not pressed; from the others the membrane goes straight to the platen. So the forces across the
   * axis are in balance, and either half of the specimen is pressed by the pressure times its height and thickness.
   *
   * The specimen must outlive it.
   */
  class Membrane
  {
  public:
    /** @param ball radius of the ball that finds the hull [m] */
    Membrane(Specimen &specimen, double ball);

    /** Lay it around the particles where they are now. @throws base::NumericalError where there is no way around */
    void lay(const EndPlanes &ends);
    /** Push the particles, where they are now, in the step to come (Specimen::add_force()). @param pressure [Pa] */
    void push(double pressure, const EndPlanes &ends) const;
    /** What push() would add to each particle that it touches. */
    struct Push
    {
      std::size_t     particle;
      Eigen::Vector3d force; ///< [N]
    };
    std::vector<Push> pushes(double pressure, const EndPlanes &ends) const;
    std::size_t       facets() const { return hull.facet.size(); }

    void visit_state(base::StateVisitor &visitor);

  private:
    /** Particles that lie at a platen: nearer to it than half their radius. */
    bool at_end(const Eigen::Vector3d &centre, double radius, const EndPlanes &ends) const;
    /** What follows from the hull, and every step needs. */
    void number_corners();

    Specimen *specimen;
    double    ball;
    double    thickness; ///< of discs [m]; 1 of spheres
    Hull      hull;

    std::vector<std::int32_t>               particles; ///< that it touches, ascending
    std::vector<std::array<std::size_t, 3>> facet;     ///< those of the hull by places in `particles`
    std::vector<std::array<std::size_t, 2>> border;    ///< edges that no other triangle has, likewise
    std::vector<int>                        goes_on; ///< of each particle: how many segments more begin there than end
  };
} // namespace dem
