#include "apps/drivers/transmission/methods.h"

namespace apps
{
  namespace
  {
    WaveMethod tied(const std::string &name, const coupling::Compatibility compatibility, const bool lumped)
    {
      WaveMethod method;
      method.name          = name;
      method.compatibility = compatibility;
      method.lumped        = lumped;
      return method;
    }

    WaveMethod absorbing(const std::string &name, const int sharpness)
    {
      WaveMethod method = tied(name, coupling::Compatibility::coarse, false);
      method.absorbs    = true;
      method.sharpness  = sharpness;
      return method;
    }

    WaveMethod led(const std::string &name, const coupling::VolumeMethod kind)
    {
      WaveMethod method;
      method.name   = name;
      method.method = kind;
      return method;
    }
  } // namespace

  const std::vector<WaveMethod> &wave_methods()
  {
    static const std::vector<WaveMethod> all = {
      absorbing("absorber", 3),
      absorbing("absorber p=2", 2),
      tied("coarse", coupling::Compatibility::coarse, false),
      tied("strict", coupling::Compatibility::strict, false),
      tied("lumped", coupling::Compatibility::strict, true),
      led("slaved", coupling::VolumeMethod::slaved),
      led("legacy", coupling::VolumeMethod::legacy),
    };
    return all;
  }
} // namespace apps
