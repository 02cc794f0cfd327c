#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace postprocess
{
  /** One element seen from the front, and its colour. */
  struct PictureFacet
  {
    std::array<std::array<double, 2>, 4> corner{}; ///< [m], in order around; a triangle repeats its last one
    double                               value = 0;
  };

  /** A particle in front of it, drawn as an outline. */
  struct PictureCircle
  {
    std::array<double, 2> centre{};   ///< [m]
    double                radius = 0; ///< [m]
  };

  /** How a field is drawn. */
  struct FieldPicture
  {
    std::string                title, label;            ///< of the picture and of the colours
    double                     lowest = 0, highest = 1; ///< of the colours
    double                     tick  = 0.25;            ///< between labels of the colours
    char                       right = 'x', up = 'y';   ///< names of the axes
    std::vector<PictureCircle> circles;
  };

  /**
   * Draw facets in colours, by gnuplot, into a PNG file.
   *
   * A picture must not cost a finished run: nothing is thrown.
   * @return empty when drawn, otherwise why not, for a warning.
   */
  [[nodiscard]] std::string picture_of_field(const std::filesystem::path     &path,
                                             const std::vector<PictureFacet> &facets,
                                             const FieldPicture              &what) noexcept;
} // namespace postprocess
