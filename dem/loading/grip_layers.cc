#include "dem/loading/grip_layers.h"

#include "dem/core/errors.h"
#include "dem/loading/section.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace dem
{
  namespace
  {
    /** Where the specimen ends along the axis: extreme surfaces and extreme centres [m]. */
    struct Ends
    {
      double low = std::numeric_limits<double>::infinity(), high = -low, low_centre = low, high_centre = high;
    };

    Ends find_ends(const SpecimenShape &specimen, const int axis)
    {
      Ends ends;
      for (std::size_t i = 0; i < specimen.centre.size(); ++i)
        {
          const double at  = specimen.centre[i][axis];
          ends.low         = std::min(ends.low, at - specimen.radius[i]);
          ends.high        = std::max(ends.high, at + specimen.radius[i]);
          ends.low_centre  = std::min(ends.low_centre, at);
          ends.high_centre = std::max(ends.high_centre, at);
        }
      return ends;
    }

    void check_grips(const double thickness, const Ends &ends)
    {
      const auto refuse = [&](const char *finding, const char *remedy) {
        std::ostringstream message;
        message << "Loading/Grip thickness = " << thickness << " m: " << finding << " The specimen measures "
                << ends.high - ends.low << " m along the axis, particle centres span "
                << ends.high_centre - ends.low_centre << " m. " << remedy;
        throw InputError(message.str());
      };
      if (ends.low + thickness >= ends.high - thickness)
        refuse("the two grips would meet.", "Use less than half of the specimen.");
      if (ends.low_centre > ends.low + thickness || ends.high_centre < ends.high - thickness)
        refuse("a grip would hold no particle.", "Use more than the radius of the particles at the ends.");
    }

    double section_between(const SpecimenShape &s, const int axis, const double grip_thickness, const Ends &ends)
    {
      const auto section = [&](const double low, const double high) {
        return s.dimension == 3 ? smallest_section(s.centre, s.radius, axis, low, high) :
                                  smallest_plane_section(s.centre, s.radius, axis, low, high, s.thickness);
      };
      const double between = section(ends.low + grip_thickness, ends.high - grip_thickness);
      // Two particles apart have nothing between their grips: then it is the section of the particles themselves.
      return std::isfinite(between) ? between : section(ends.low, ends.high);
    }
  } // namespace

  GripLayers find_grip_layers(const SpecimenShape &specimen, const int axis, const double grip_thickness)
  {
    const Ends ends = find_ends(specimen, axis);
    check_grips(grip_thickness, ends);
    GripLayers layers;
    layers.length  = ends.high_centre - ends.low_centre;
    layers.middle  = 0.5 * (ends.low_centre + ends.high_centre);
    layers.section = section_between(specimen, axis, grip_thickness, ends);
    for (std::size_t i = 0; i < specimen.centre.size(); ++i)
      {
        if (specimen.centre[i][axis] <= ends.low + grip_thickness)
          layers.low.push_back(i);
        if (specimen.centre[i][axis] >= ends.high - grip_thickness)
          layers.high.push_back(i);
      }
    return layers;
  }
} // namespace dem
