#include "apps/scene/entries/precice.h"

#include "apps/scene/section.h"

namespace apps
{
  void declare(Section &root, PreciceSection &precice, const char *const vertices, const char *const meaning)
  {
    const auto  given = [&precice] { return precice.given(); };
    const char *when  = "preCICE/Participant is given";
    Section    &s = root.section("preCICE", "Coupling with other programs by preCICE 3, where this one was built with "
                                               "it: either force is read and motion written, or one kind of motion read and "
                                               "force written; empty names of data: not exchanged");
    s.text("Participant", precice.participant, Need::optional)
      .means("Name of this side in the configuration of preCICE; empty: nothing is coupled");
    s.file("Configuration", precice.configuration).means("File of preCICE").only_if(given, when);
    s.text("Mesh", precice.mesh, Need::required).means("Name of this side's mesh").only_if(given, when);
    s.text(vertices, precice.vertices, Need::required).means(meaning).only_if(given, when);
    const auto data = [&](const char *entry, std::string &name, const char *what) {
      s.text(entry, name, Need::optional).means(what).only_if(given, when);
    };
    data("Read force", precice.reads.force, "Data that push the vertices during each time window [N]");
    data("Read displacement", precice.reads.displacement,
         "Data that prescribe the vertices' displacement since the start of the coupling [m]");
    data("Read velocity", precice.reads.velocity, "Data that prescribe the vertices' velocity [m/s]");
    data("Write force", precice.writes.force,
         "Data that become the body's force on what leads it [N], without the inertia of the vertices");
    data("Write displacement", precice.writes.displacement,
         "Data that become the vertices' displacement since the start of the coupling [m]");
    data("Write velocity", precice.writes.velocity, "Data that become their velocity half a step back [m/s]");
  }
} // namespace apps
