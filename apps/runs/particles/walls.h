#pragma once

#include "apps/models/contact_law.h"
#include "apps/text/vector_formula.h"
#include "base/entry_path.h"
#include "dem/facets/surface.h"
#include "dem/specimen/specimen.h"

#include <array>
#include <cstdint>
#include <list>
#include <string>
#include <vector>

namespace apps
{
  /** Sub-section of "Walls". */
  struct WallSection
  {
    enum class Shape
    {
      plane,
      plate,
      box,
      cylinder,
      file
    };
    enum class Control
    {
      motion,
      force
    };

    std::string           name;
    Shape                 shape = Shape::plane;
    std::array<double, 3> point = {0, 0, 0}, normal = {0, 0, 1};                               ///< of a plane
    std::array<double, 3> corner = {0, 0, 0}, first_edge = {0, 0, 0}, second_edge = {0, 0, 0}; ///< of a plate
    std::array<double, 3> lower = {0, 0, 0}, upper = {0, 0, 0};                                ///< of a box
    std::vector<int>      open;                                                                ///< sides of it
    std::array<double, 3> from = {0, 0, 0}, to = {0, 0, 0};                                    ///< of a cylinder
    double                radius = 0;
    std::int64_t          around = 36;
    bool                  ends   = false;
    std::string           file;
    double                scale = 0;

    ContactLaw contact;

    Control               control = Control::motion;
    Expressions           velocity, spin;
    std::array<double, 3> centre    = {0, 0, 0};
    std::array<double, 3> direction = {0, 0, 0};
    Expression            force;
    double                largest_speed = 0, gain = 0.1;

    /** @throws base::InputError. */
    void check(const base::EntryPath &section, int dimension) const;
    /** @throws base::InputError for a file that holds no wall */
    dem::FacetMesh mesh(int dimension) const;
    bool           is_plane() const { return shape == Shape::plane; }
  };

  /** Section "Walls": what particles touch besides each other. */
  struct WallsSection
  {
    std::list<WallSection> walls;

    /** @throws base::InputError. */
    void                     check(const base::EntryPath &root, int dimension) const;
    bool                     knows(const std::string &name) const;
    std::vector<std::string> names() const;
  };

  /** The walls of a specimen, driven as a scene says. The specimen must outlive it. */
  class Walls
  {
  public:
    /** @throws base::InputError naming the wall that cannot be */
    Walls(dem::Specimen &specimen, const WallsSection &section);

    /** Velocities of the next step (those at its middle) and forces of servos. */
    void drive_next_step();
    bool varies() const { return varying; } ///< in time: they must be driven before every step

    const dem::Surface &surface(const std::string &name) const;
    /** "floor 2 facets, piston 2 facets at a force"; "" without walls */
    std::string text() const;

  private:
    void drive(std::size_t wall);

    dem::Specimen           *specimen;
    std::vector<WallSection> walls; ///< numbered as the surfaces
    bool                     varying = false;
  };
} // namespace apps
