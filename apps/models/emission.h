#pragma once

namespace apps
{
  /** Section "Emission": whether the specimen is listened to as it breaks. */
  struct EmissionSection
  {
    double reach = 0; ///< of one event, in mean diameters of the particles; 0: not listened to

    bool given() const { return reach > 0; }
  };
} // namespace apps
