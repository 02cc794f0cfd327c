#include "apps/models/specimen_parameters.h"

namespace apps
{
  dem::SpecimenParameters
  specimen_parameters(const SpecimenSection &source, const dem::Physics &physics, const TimeSection &time)
  {
    dem::SpecimenParameters parameters;
    parameters.physics           = physics;
    parameters.density           = source.density;
    parameters.interaction_ratio = source.interaction_ratio;
    parameters.thickness         = source.thickness;
    parameters.step_factor       = time.step_factor;
    parameters.damping           = time.damping;
    return parameters;
  }
} // namespace apps
