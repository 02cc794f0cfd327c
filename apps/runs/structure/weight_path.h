#pragma once

#include "dem/statics/quasi_static_path.h"

namespace apps
{
  /** A structure while its weight is put on, before anything is driven (doc/theory/static-handshake.md, 5). */
  class WeightPath
  {
  public:
    /**
     * @param whole has a dead load, the weight
     * @param along how the structure is driven afterwards
     * @param released what is driven then bears nothing now, and moves as the rest lets it; otherwise it stays where it is
     * @throws base::InputError where nothing holds the structure against its weight
     */
    WeightPath(const dem::LoadedNetwork         &whole,
               const dem::LinkMaterials         &materials,
               const dem::QuasiStaticParameters &along,
               bool                              released);
    WeightPath(const WeightPath &)            = delete;
    WeightPath &operator=(const WeightPath &) = delete;

    dem::QuasiStaticPath       &way() { return path; }
    const dem::QuasiStaticPath &way() const { return path; }

    /** One point further. @throws StoppedShort where the structure does not bear its weight */
    void advance();

  private:
    double part() const { return path.points().back().strain[network.driven]; } ///< of the weight that is on

    dem::LoadedNetwork   network;
    dem::QuasiStaticPath path;
  };
} // namespace apps
