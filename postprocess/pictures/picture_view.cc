#include "postprocess/pictures/picture_view.h"

#include "postprocess/files/numeric_text.h"

#include <algorithm>
#include <stdexcept>

namespace postprocess
{
  PictureView::PictureView(const dem::ParticleOutput &particles_, const PictureSlab &slab_)
    : particles(particles_)
    , slab(slab_)
    , right(slab.axis == 0 ? 1 : 0)
    , up(slab.axis == 2 ? 1 : 2)
  {
    if (slab.axis < 0 || slab.axis > 2)
      throw std::invalid_argument("the axis of the slab is 0, 1 or 2");
    if (particles.position.empty())
      throw std::invalid_argument("there is no particle");
    double lowest = origin(0)[slab.axis], highest = lowest, radii = 0;
    for (std::size_t i = 0; i < particles.position.size(); ++i)
      {
        lowest  = std::min(lowest, origin(i)[slab.axis]);
        highest = std::max(highest, origin(i)[slab.axis]);
        radii += particles.radius[i];
      }
    middle     = slab.position.value_or((lowest + highest) / 2);
    half_width = slab.thickness.value_or(4 * radii / particles.radius.size()) / 2;
  }

  /** Farther from the eye, which looks along y, and against x and z, so that the other two axes go right and up. */
  bool PictureView::is_behind(const std::size_t i, const std::size_t j) const
  {
    const double depth_i = origin(i)[slab.axis], depth_j = origin(j)[slab.axis];
    return slab.axis == 1 ? depth_i > depth_j : depth_i < depth_j;
  }

  std::vector<std::size_t> PictureView::shown() const
  {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < particles.position.size(); ++i)
      if (shows(i))
        found.push_back(i);
    if (found.empty())
      throw std::invalid_argument("there is no particle in the slab");
    std::stable_sort(found.begin(), found.end(), [&](const auto i, const auto j) { return is_behind(i, j); });
    return found;
  }

  Eigen::AlignedBox2d PictureView::frame(const std::vector<std::size_t> &of) const
  {
    Eigen::AlignedBox2d now, at_first;
    for (const std::size_t i : of)
      {
        const Eigen::Vector2d radius = Eigen::Vector2d::Constant(particles.radius[i]);
        const Eigen::Vector2d before = projected(origin(i));
        now.extend(on_paper(i) - radius).extend(on_paper(i) + radius);
        at_first.extend(before - radius).extend(before + radius);
      }
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(at_first.sizes().maxCoeff() / 5);
    return now.intersection(Eigen::AlignedBox2d(at_first.min() - margin, at_first.max() + margin));
  }

  void append_row(std::string &text, const std::initializer_list<double> values)
  {
    for (const double value : values)
      {
        numeric_text::append(text, value);
        text += ' ';
      }
    text += '\n';
  }
} // namespace postprocess
