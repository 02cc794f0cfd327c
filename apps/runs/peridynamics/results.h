#pragma once

#include "apps/runs/peridynamics/analysis.h"
#include "postprocess/pictures/field_picture.h"

#include <filesystem>
#include <string>
#include <vector>

namespace apps
{
  /** A body as files and pictures show it. */
  struct PeridynamicState
  {
    const dem::peridynamics::Bonds &bonds;
    dem::peridynamics::Field        displacement; ///< without rigid motion where nothing is held
    std::vector<double>             damage;       ///< in the order of the grid's nodes

    PeridynamicState(const PeridynamicBody &body, const dem::peridynamics::Field &u);

    /** A row per node: place, displacement, damage, volume. @throws postprocess::OutputError */
    void write_table(const std::filesystem::path &file) const;
    /** A point per node, for ParaView. @throws postprocess::OutputError */
    void write_points(const std::filesystem::path &file, double time) const;

    enum class Shown
    {
      displacement,
      damage
    };
    /** Of a plate, or of the plane of a block nearest to its middle; deformed and magnified. @return what went wrong, "" if nothing */
    std::string draw(const std::filesystem::path &file, const std::string &title, Shown shown) const;

    /** By which displacements are magnified in a picture of a body of this length [m]. */
    double magnification(double length) const;
    /** Squares of the nodes that draw() shows; their values are damage, or displacement [m]. */
    std::vector<postprocess::PictureFacet> facets(Shown shown, double magnify) const;
    /** Draw such facets. @return what went wrong, "" if nothing */
    static std::string draw_facets(const std::filesystem::path           &file,
                                   const std::string                     &title,
                                   std::vector<postprocess::PictureFacet> facets,
                                   Shown                                  shown);
    /** "hole, displacements x 100", of a block with the plane that is drawn. */
    std::string title_of_picture(const std::string &title, double magnify) const;

  private:
    int plane() const; ///< of a block, that is drawn
    /** Numbers of the nodes' materials, where there are several. */
    std::vector<double> materials() const;
  };
} // namespace apps
