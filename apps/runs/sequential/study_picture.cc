#include "apps/runs/sequential/study.h"
#include "postprocess/pictures/drawn_unit.h"
#include "postprocess/pictures/plot.h"

#include <algorithm>
#include <cmath>

namespace apps
{
  namespace
  {
    using postprocess::PlotPanel;
    using postprocess::PlotSeries;

    constexpr const char *grey = "#9a9a9a", *pale_grey = "#d0d0d0", *black = "#000000";

    /** From what a study computes to what is drawn. */
    struct Axes
    {
      double      x = 1, y = 1; ///< by which values are multiplied
      std::string x_label, y_label, peak_label;
    };

    Axes axes_of_strain_and_stress(const StudyReport &study)
    {
      const double up = study.model.particles.compresses() ? -1 : 1;
      return {up * 1e3, up * 1e-6, "Strain [1e-3]", "Stress [MPa]", "Largest stress [MPa]"};
    }

    Axes axes_of_columns(const StudyReport &study)
    {
      double widest = 0, highest = 0;
      for (const ContinuationCurve &curve : study.curves)
        {
          widest  = std::max(widest, std::abs(curve.furthest()));
          highest = std::max(highest, std::abs(curve.peak()));
        }
      const auto along           = postprocess::drawn_unit(widest, study.units.horizontal),
                 force           = postprocess::drawn_unit(highest, study.units.vertical);
      const std::string vertical = postprocess::readable(study.model.study.vertical);
      return {along.scale, force.scale, postprocess::readable(study.model.study.horizontal) + along.label,
              vertical + force.label, vertical + ", largest" + force.label};
    }

    /** @param offset of x, before it is scaled */
    PlotSeries line(const std::string         &name,
                    const char                *colour,
                    const Axes                &axes,
                    const std::vector<double> &x,
                    const std::vector<double> &y,
                    const double               offset = 0)
    {
      PlotSeries drawn;
      drawn.style  = PlotSeries::Style::line;
      drawn.name   = name;
      drawn.colour = colour;
      for (std::size_t i = 0; i < x.size(); ++i)
        {
          drawn.x.push_back(axes.x * (offset + x[i]));
          drawn.y.push_back(axes.y * y[i]);
        }
      return drawn;
    }

    /** One case: the particles to the hand-over, the continuum from there on, and the particles alone. */
    PlotPanel case_panel(const StudyReport &study, const Axes &axes, const std::size_t k)
    {
      const ParticleOutcome   &before = study.particles[k];
      const ContinuationCurve &after  = study.curves[k];
      PlotPanel                panel;
      panel.title   = "handed over at " + before.name;
      panel.x_label = axes.x_label;
      panel.y_label = axes.y_label;
      if (study.all_particles)
        panel.series.push_back(line("particles alone", pale_grey, axes, study.all_particles->curve_strain,
                                    study.all_particles->curve_stress));
      panel.series.push_back(line("particles to the hand-over", grey, axes, before.curve_strain, before.curve_stress));
      panel.series.push_back(line("continuum", black, axes, after.horizontal, after.vertical, after.offset));
      return panel;
    }

    /** All continuations over each other, for particles without strain and stress of their own. */
    PlotPanel panel_of_all(const StudyReport &study, const Axes &axes)
    {
      PlotPanel panel;
      panel.title   = "Continuations";
      panel.x_label = axes.x_label;
      panel.y_label = axes.y_label;
      for (std::size_t k = 0; k < study.curves.size(); ++k)
        panel.series.push_back(
          line(study.particles[k].name, "", axes, study.curves[k].horizontal, study.curves[k].vertical));
      return panel;
    }

    /** Peak of each continuation over how hard its event was. */
    PlotPanel panel_of_what_is_left(const StudyReport &study, const Axes &axes, const bool stresses)
    {
      PlotSeries left;
      // Monotonic and unloaded states have the same strain: no line joins them.
      left.style = stresses ? PlotSeries::Style::points : PlotSeries::Style::line_and_points;
      for (std::size_t k = 0; k < study.curves.size(); ++k)
        if (std::isfinite(study.curves[k].peak()))
          {
            left.x.push_back((stresses ? axes.x : 1) * study.particles[k].severity);
            left.y.push_back(std::abs(axes.y) * study.curves[k].peak());
          }
      PlotPanel panel;
      panel.title   = "What the continuum still carries";
      panel.x_label = stresses ? "Strain reached by the particles [1e-3]" : "Energy of the blow [J]";
      panel.y_label = axes.peak_label;
      if (study.all_particles)
        {
          PlotSeries particles;
          particles.style  = PlotSeries::Style::points;
          particles.name   = "particles alone, from there on";
          particles.colour = grey;
          for (std::size_t k = 0; k < study.curves.size(); ++k)
            {
              particles.x.push_back(axes.x * study.particles[k].severity);
              particles.y.push_back(std::abs(axes.y) * largest_from(*study.all_particles, study.curves[k].offset));
            }
          left.name    = "continuum";
          left.colour  = black;
          panel.series = {particles, left};
        }
      else
        panel.series = {left};
      return panel;
    }
  } // namespace

  std::string StudyReport::draw(const std::filesystem::path &file) const
  {
    const bool             stresses = model.particles.source == ParticleEventSection::Source::uniaxial;
    const Axes             axes     = stresses ? axes_of_strain_and_stress(*this) : axes_of_columns(*this);
    std::vector<PlotPanel> panels;
    for (std::size_t k = 0; stresses && k < curves.size(); ++k)
      panels.push_back(case_panel(*this, axes, k));
    if (!stresses)
      panels.push_back(panel_of_all(*this, axes));
    panels.push_back(panel_of_what_is_left(*this, axes, stresses));
    return postprocess::plot(file, panels);
  }
} // namespace apps
