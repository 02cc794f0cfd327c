#pragma once

#include "postprocess/pictures/specimen_picture.h"

#include <Eigen/Geometry>

#include <initializer_list>
#include <string>
#include <vector>

namespace postprocess
{
  /** A slab of a specimen with its numbers filled in, and the two axes of the picture. What it is made of must outlive it. */
  class PictureView
  {
  public:
    /** @throws std::invalid_argument for an axis that is none, and without particles */
    PictureView(const dem::ParticleOutput &particles_, const PictureSlab &slab_);

    bool shows(const Eigen::Vector3d &place) const { return std::abs(place[slab.axis] - middle) <= half_width; }
    bool shows(const std::size_t i) const { return shows(origin(i)); }
    /** Particles in the slab, the farthest first, so that nearer ones are drawn over them. @throws std::invalid_argument where there is none */
    std::vector<std::size_t> shown() const;
    /** What the picture shows [m]: all circles of these particles, but debris only near the specimen. */
    Eigen::AlignedBox2d frame(const std::vector<std::size_t> &shown) const;

    /** Where what was made at the first place and was displaced is drawn [m]. */
    Eigen::Vector2d on_paper(const Eigen::Vector3d &place, const Eigen::Vector3d &displacement) const
    {
      return projected(place + slab.magnify * displacement);
    }
    Eigen::Vector2d on_paper(const std::size_t i) const { return on_paper(origin(i), particles.displacement[i]); }
    Eigen::Vector2d projected(const Eigen::Vector3d &vector) const { return {vector[right], vector[up]}; }

    /** Where the particle was when the specimen was made. */
    Eigen::Vector3d origin(const std::size_t i) const { return particles.position[i] - particles.displacement[i]; }

    bool leads_to_image(const std::size_t link) const
    {
      return !slab.images.empty() && slab.images.at(link).is_other();
    }
    const dem::LinkImage &image(const std::size_t link) const { return slab.images.at(link); }

    char name_of_right() const { return "xyz"[right]; }
    char name_of_up() const { return "xyz"[up]; }

  private:
    bool is_behind(std::size_t i, std::size_t j) const;

    const dem::ParticleOutput &particles;
    const PictureSlab         &slab;
    int                        right, up;
    double                     middle, half_width;
  };

  /** A row of numbers for gnuplot. */
  void append_row(std::string &text, std::initializer_list<double> values);
} // namespace postprocess
