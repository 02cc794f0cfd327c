#include "apps/scene/absent.h"

#include "apps/text/same_name.h"

#include <vector>

namespace apps
{
  namespace
  {
    struct Absent
    {
      std::vector<const char *> names;
      const char               *answer;
    };

    const std::vector<Absent> &all_absent()
    {
      static const std::vector<Absent> all = {
        {{"MPI", "mpirun"},
         "Scenes of kind cell, continuum, coupled, homogenisation, particles, quasi_static, structure and uniaxial, "
         "and \"breccia homogenise\", "
         "share their work among the processes of mpirun (doc/tutorials/many_ranks.md); others run on the threads of "
         "one machine (--threads)."},
        {{"Python", "pybind", "bindings"},
         "Scenes are text files, changed by -s. From Python they are run by the module that \"./breccia python\" "
         "builds "
         "(doc/tutorials/python.md)."},
        {{"calibration", "calibrate", "optimisation", "optimization", "optimise", "optimize"},
         "Constants are sought by \"breccia calibrate\" (doc/tutorials/calibrate.md) and by \"breccia invert\"; "
         "doc/tutorials/constants.md says which constant moves which figure."},
        {{"Mix"},
         "A mix is of particles that a scene makes or reads: scenes of kind cell, coupled, particles, quasi_static, "
         "sequential, structure and uniaxial have Specimen/Mix, and so have Law = cells and \"breccia homogenise "
         "PACKING --materials SCENE\". Sweeps of kind homogenisation are of one material."},
        {{"fabric", "coordination", "couple stress", "stress tensor"},
         "These are printed by \"breccia measure\" for a state that a run of bonded particles left "
         "(doc/theory/stress-and-fabric.md)."},
        {{"rebar", "rebars", "reinforcement", "reinforcing bar", "steel bar"},
         "Bars of reinforcement are not modelled: concrete is plain."},
        {{"temperature", "heat", "fluid", "pore pressure", "permeability", "moisture", "shrinkage"},
         "Scenes are mechanical: heat, moisture and fluids are not modelled."},
        {{"GPU", "CUDA"}, "Nothing runs on a graphics processor: particles run on threads (--threads)."},
        {{"Poisson ratio", "Poisson's ratio", "Poissons ratio"},
         "Links have no Poisson's ratio: that of a specimen follows from \"Shear ratio\" (CPM) or \"Stiffness ratio\" "
         "(other laws), see doc/tutorials/constants.md."},
        {{"Young modulus", "Young's modulus", "Youngs modulus"},
         "Links have no Young's modulus: that of a specimen follows from \"Normal modulus\" (CPM) or \"Effective "
         "modulus\" (other laws), see doc/tutorials/constants.md."}};
      return all;
    }
  } // namespace

  std::string absent(const std::string &typed)
  {
    for (const Absent &one : all_absent())
      for (const char *name : one.names)
        if (same_name(typed, name))
          return one.answer;
    return {};
  }
} // namespace apps
