#include "apps/runs/transmission/methods.h"

namespace apps
{
  namespace
  {
    coupling::WaveMethod tied(const std::string &name, const coupling::Compatibility compatibility, const bool lumped)
    {
      coupling::WaveMethod method;
      method.name          = name;
      method.compatibility = compatibility;
      method.lumped        = lumped;
      return method;
    }

    coupling::WaveMethod absorbing(const std::string &name, const int sharpness)
    {
      coupling::WaveMethod method = tied(name, coupling::Compatibility::coarse, false);
      method.absorbs              = true;
      method.sharpness            = sharpness;
      return method;
    }

    coupling::WaveMethod driven(const std::string &name, const coupling::VolumeMethod kind)
    {
      coupling::WaveMethod method;
      method.name   = name;
      method.method = kind;
      return method;
    }
  } // namespace

  const std::vector<coupling::WaveMethod> &wave_methods()
  {
    static const std::vector<coupling::WaveMethod> all = {
      absorbing("absorber", 3),
      absorbing("absorber p=2", 2),
      tied("coarse", coupling::Compatibility::coarse, false),
      tied("strict", coupling::Compatibility::strict, false),
      tied("lumped", coupling::Compatibility::strict, true),
      driven("constrained", coupling::VolumeMethod::constrained),
      driven("legacy", coupling::VolumeMethod::legacy),
    };
    return all;
  }

  std::string wave_method_names()
  {
    std::string names;
    for (const coupling::WaveMethod &method : wave_methods())
      names += (names.empty() ? "" : ", ") + method.name;
    return names;
  }
} // namespace apps
