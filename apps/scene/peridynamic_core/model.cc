#include "apps/scene/peridynamic_core/model.h"

#include "apps/scene/continuum/model.h"
#include "apps/scene/entries/output.h"
#include "apps/scene/peridynamics/model.h"
#include "apps/scene/number_list.h"
#include "apps/scene/section.h"

namespace apps
{
  namespace
  {
    void declare_handshake(Section &root, CoreHandshakeSection &handshake)
    {
      Section &s =
        root.section("Handshake", "The layer in which elements and bonds both are: across it the share of the "
                                  "elements grows from nothing to all. Elements within go");
      declare_names(s, "Sides", handshake.sides, Need::optional)
        .means(
          "Of the core that lie in the elements, between commas: left, right, bottom, top, back, front; the others "
          "are sides of the whole body");
      s.number("Overlap", handshake.width, "m", Range::positive(), Need::required)
        .means("Width of the layer, inwards from these sides; an element at least");
      s.choice("Ties", handshake.ties,
               {{"coarse", coupling::Compatibility::coarse}, {"strict", coupling::Compatibility::strict}},
               Need::optional)
        .means(
          "coarse: mean velocities around each node of the mesh are equal; strict: those at every node of the core");
    }
  } // namespace

  void declare(Section &root, PeridynamicCoreModel &model)
  {
    declare_as_part(root.section("Continuum", "The solid; sections of a scene of kind continuum, in explicit motion"),
                    model.continuum);
    declare_as_part(
      root.section("Core", "The peridynamic core, centred at the origin; sections of a scene of kind peridynamics"),
      model.core);
    declare_handshake(root, model.handshake);
    root.section("Time", "How long it takes")
      .number("End time", model.end_time, "s", Range::positive(), Need::required)
      .means("Of the motion");
    declare(root, model.output);
    Section &output = *root.find_section("Output");
    output.text("Curve horizontal", model.horizontal, Need::optional)
      .means("Column of series.csv for curve.png; empty: the time")
      .housekeeping();
    output.text("Curve vertical", model.vertical, Need::optional)
      .means("Column of series.csv for curve.png; empty: the first reaction, or the kinetic energy of the core")
      .housekeeping();
  }
} // namespace apps
