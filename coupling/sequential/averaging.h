#pragma once

#include "coupling/sequential/particle_field.h"

#include <memory>

namespace coupling
{
  /** How particle tensors become tensors at a point. All weights are times the particle's volume. */
  enum class Kernel
  {
    nearest,              ///< of the nearest particle alone
    ball,                 ///< equal weights within the width
    gaussian,             ///< exp(-d^2/(2 width^2)) within three widths
    moving_least_squares, ///< linear fit with the Gaussian's weights: exact for linear fields, also at boundaries
    specimen              ///< all particles, everywhere the same
  };

  struct AveragingOptions
  {
    Kernel      kernel = Kernel::gaussian;
    double      width  = 0; ///< [m]; 0: the larger of half the size given and three mean radii
    std::size_t fewest = 8; ///< an average of fewer particles is called sparse
  };

  /** What a point got from the particles. */
  struct Average
  {
    Eigen::Matrix3d stress    = Eigen::Matrix3d::Zero(); ///< [Pa]
    Eigen::Matrix3d damage    = Eigen::Matrix3d::Zero(); ///< Omega
    std::size_t     particles = 0;                       ///< within reach; 0: nothing is known, both tensors are zero
    double          width     = 0;                       ///< used [m]
    /**
     * Distance of the weights' centre from the point, in widths: about 0 inside, 0.8 on a flat surface (Gaussian). It is what the
     * average of a field that changes by g over a width is wrong by, in g; of a linear fit it is corrected.
     */
    double offset = 0;
    bool   linear = false; ///< the linear fit was used; moving least squares falls back to the average where it cannot
  };

  /** Width of the kernel in an element of that size, see AveragingOptions [m]. */
  double width_of(const AveragingOptions &options, const ParticleField &field, double element_size);

  /** Averages a field at any number of points. The field must outlive it. */
  class Averaging
  {
  public:
    /** @throws base::InputError for a negative width */
    Averaging(const ParticleField &field, const AveragingOptions &options);
    ~Averaging();

    /** @param element_size of the element around the point, or the longer length of its material [m] */
    Average at(const Eigen::Vector3d &place, double element_size) const;

  private:
    class Search;
    struct Weighted;

    bool                  fit_linearly(const std::vector<Weighted> &near, Average &average) const;
    std::vector<Weighted> weigh(const Eigen::Vector3d &place, double width) const;

    const ParticleField    *field;
    AveragingOptions        options;
    std::unique_ptr<Search> search;
  };
} // namespace coupling
