// SPDX-License-Identifier: Apache-2.0
#include "farm/run/rank_state.h"

namespace vitrail {

RankState::RankState(const RenderScene& the_scene, Film& the_film, WorkPlan the_work, const JobPlan& job,
                     const RenderOptions& options)
    : scene(the_scene),
      film(the_film),
      plan(std::move(the_work)),
      scheduler(job.scheduler, Residency(scene.manifest, job.memory.domains_bytes, job.homes,
                                         job.scheduler.rank, options.resources.distribution)),
      queues(scene.manifest.domains.size(), job.queues.waiting, options.resources.shuffle_seed),
      outgoing(scene.manifest.domains.size(), job.queues.outgoing, std::nullopt),
      domains(scene.manifest, options.bundle, options.resources.traversal) {
  const int ranks = job.scheduler.ranks;
  if (job.key.photons.photons > 0)
    photons.emplace(scene, job.key.photons, job.most_photons, job.queues.questions, job.homes,
                    job.scheduler.rank, ranks);
  if (!options.outputs.profile.empty()) work.profiling.emplace(scene.manifest.domains.size());
  if (!options.outputs.trace.empty()) work.timeline.emplace(Timeline::most_events(ranks));
}

void note(RankState& state, Timeline::Kind kind, RankState::Clock::time_point begin,
          const Timeline::Values& values) {
  if (!state.work.timeline) return;
  const Locked locked(state);
  state.work.timeline->add(kind, 0, begin, RankState::Clock::now(), values);
}

void fail(RankState& state, std::exception_ptr why) {
  const Locked locked(state);
  if (!state.failure) state.failure = std::move(why);
}

}  // namespace vitrail
