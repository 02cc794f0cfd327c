#include "apps/bench/size_effect_answer.h"

#include "apps/statistics/sample.h"
#include "base/errors.h"

#include <fmt/format.h>

#include <optional>
#include <set>

namespace apps
{
  namespace
  {
    std::string in_words(const Estimate &e, const double unit, const char *name)
    {
      return e.determined() ? fmt::format("{:.3g} ± {:.2g}{} (standard error {:.2g})", unit * e.value,
                                          unit * e.half_width, name, unit * e.standard_error) :
                              fmt::format("{:.3g}{} (not determined)", unit * e.value, name);
    }

    std::vector<SizeStrength> strengths_of(const std::vector<BrokenBeam> &all, const bool notched)
    {
      std::vector<SizeStrength> found;
      for (const BrokenBeam &beam : all)
        if (beam.of.notched == notched && !beam.of.all_particles)
          found.push_back({beam.depth, beam.strength, notched ? notch_of_beams : 0});
      return found;
    }

    std::size_t sizes_of(const std::vector<SizeStrength> &beams)
    {
      std::set<double> depths;
      for (const SizeStrength &beam : beams)
        depths.insert(beam.depth);
      return depths.size();
    }

    /** Fits law by law; one that cannot be is said, and left out. */
    class AnswerMaker
    {
    public:
      AnswerMaker(const std::vector<BrokenBeam> &beams, const int calibrated, const double modulus)
        : all(beams)
        , notched(strengths_of(beams, true))
        , smooth(strengths_of(beams, false))
        , one_size(calibrated)
        , young(modulus)
      {
      }

      SizeEffectAnswer made()
      {
        NamedLaw one{"r = 1", {}, {}}, free{"free exponent", {}, {}}, universal{"universal", {}, {}},
          predicted{fmt::format("from size {} alone", one_size), {}, {}};
        if (!notched.empty())
          attempt("with a notch", [&] { fit_notched(one, free); });
        if (!smooth.empty())
          attempt("without a notch", [&] { fit_smooth(one, free); });
        if (one.notched && one.smooth && notched.size() + smooth.size() > 5)
          attempt("of both kinds", [&] { fit_universal(universal); });
        if (!notched.empty())
          attempt(predicted.name, [&] { predict(predicted); });
        answer.laws  = {one, free, universal, predicted};
        answer.model = strength_of(true) / strength_of(false);
        return answer;
      }

    private:
      template <typename Fit>
      void attempt(const std::string &which, const Fit &fit)
      {
        try
          {
            fit();
          }
        catch (const base::InputError &refusal)
          {
            answer.words.push_back("Not found, " + which + ": " + refusal.what());
          }
      }

      void fit_notched(NamedLaw &one, NamedLaw &free)
      {
        const SizeEffectLaw law = fitted_bazant(notched);
        one.notched             = [law](const double D) { return law.at(D); };
        const CrackOfLaw crack  = crack_of(law, notch_of_beams, young);
        answer.words.push_back(fmt::format("With a notch, r = 1: sigma_0 {}, D_0 {}; G_f {:.3g} J/m², c_f {:.3g} mm.",
                                           in_words(law.strength, 1e-6, " MPa"), in_words(law.depth, 1e3, " mm"),
                                           crack.energy, 1e3 * crack.zone));
        if (sizes_of(notched) < 3)
          return;
        const SizeEffectLaw second = fitted_with_exponent(notched);
        free.notched               = [second](const double D) { return second.at(D); };
        answer.words.push_back(fmt::format("With a notch, free exponent: r {}, sigma_0 {}, D_0 {}.",
                                           in_words(second.exponent, 1, ""), in_words(second.strength, 1e-6, " MPa"),
                                           in_words(second.depth, 1e3, " mm")));
      }

      void fit_smooth(NamedLaw &one, NamedLaw &free)
      {
        const SmoothBeamLaw law = fitted_smooth(smooth);
        one.smooth              = [law](const double D) { return law.at(D); };
        answer.words.push_back(fmt::format("Without a notch, r = 1: f_inf {}, D_b {}.",
                                           in_words(law.strength, 1e-6, " MPa"), in_words(law.layer, 1e3, " mm")));
        if (sizes_of(smooth) < 3)
          return;
        const SmoothBeamLaw second = fitted_smooth_with_exponent(smooth);
        free.smooth                = [second](const double D) { return second.at(D); };
        answer.words.push_back(fmt::format("Without a notch, free exponent: r {}, f_inf {}, D_b {}.",
                                           in_words(second.exponent, 1, ""), in_words(second.strength, 1e-6, " MPa"),
                                           in_words(second.layer, 1e3, " mm")));
      }

      void fit_universal(NamedLaw &universal)
      {
        std::vector<SizeStrength> both = notched;
        both.insert(both.end(), smooth.begin(), smooth.end());
        const UniversalLaw law = fitted_universal(both, young);
        universal.notched      = [law](const double D) { return law.at({D, 0, notch_of_beams}); };
        universal.smooth       = [law](const double D) { return law.at({D, 0, 0}); };
        answer.words.push_back(fmt::format("Both, universal: G_f {}, c_f {}, f_inf {}, D_b {}, r {}.",
                                           in_words(law.energy, 1, " J/m²"), in_words(law.zone, 1e3, " mm"),
                                           in_words(law.strength, 1e-6, " MPa"), in_words(law.layer, 1e3, " mm"),
                                           in_words(law.exponent, 1, "")));
      }

      /** Mean of the notched beams of the one size. */
      double strength_of(const bool all_particles) const
      {
        return figure_of(all, {one_size, 1, true, all_particles, false}, &BrokenBeam::strength).mean;
      }

      void predict(NamedLaw &predicted)
      {
        const BeamCase      size{one_size, 1, true, false, true};
        const double        work = figure_of(all, size, &BrokenBeam::work).mean;
        const SizeStrength  beam{figure_of(all, size, &BrokenBeam::depth).mean,
                                figure_of(all, size, &BrokenBeam::strength).mean, notch_of_beams};
        const SizeEffectLaw law = law_of_one_size(beam, work, notch_of_beams, young);
        predicted.notched       = [law](const double D) { return law.at(D); };
        const double zone       = crack_of(law, notch_of_beams, young).zone;
        answer.words.push_back(
          fmt::format("From size {} alone: G_F {:.3g} J/m², c_f {:.3g} mm.", one_size, work, 1e3 * zone));
        BeamCase without = size;
        without.notched  = false;
        if (const FigureOfSize strength = figure_of(all, without, &BrokenBeam::strength); strength.beams > 0)
          {
            const SmoothBeamLaw other = smooth_law_of_one_size({beam.depth, strength.mean}, zone);
            predicted.smooth          = [other](const double D) { return other.at(D); };
          }
      }

      const std::vector<BrokenBeam>  &all;
      const std::vector<SizeStrength> notched, smooth;
      const int                       one_size;
      const double                    young;
      SizeEffectAnswer                answer;
    };
  } // namespace

  FigureOfSize figure_of(const std::vector<BrokenBeam> &all, const BeamCase &like, double BrokenBeam::*const member)
  {
    std::vector<double> values;
    for (const BrokenBeam &b : all)
      if (b.of.size == like.size && b.of.notched == like.notched && b.of.all_particles == like.all_particles)
        values.push_back(b.*member);
    const statistics::SampleMoments found = statistics::moments_of(values);
    return {found.mean, found.deviation, static_cast<int>(found.count)};
  }

  SizeEffectAnswer size_effect_answer(const std::vector<BrokenBeam> &all, const int calibrated, const double young)
  {
    return AnswerMaker(all, calibrated, young).made();
  }
} // namespace apps
