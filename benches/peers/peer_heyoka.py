"""heyoka: Taylor's method with terminal events at both walls, the restitution in their callbacks."""

import math

import heyoka as hy

from problem import G, GAPS, ONE_IMPACT, START, say, seconds

z, v = hy.make_vars("z", "v")
r_b, r_t, d = (hy.par[i] for i in range(3))


class Ball:
    """The integrator is compiled once; gap and restitution are its parameters."""

    def __init__(self):
        self.last = []
        walls = [hy.t_event(z - side * d / 2, direction=direction, callback=self.wall(index))
                 for index, (side, direction) in enumerate([(1, hy.event_direction.positive), (-1, hy.event_direction.negative)])]
        flow = [(z, v), (v, hy.cos(math.pi * hy.time) + G)]
        self.motion = hy.taylor_adaptive(flow, [0.0, 0.0], pars=[1.0] * 3, t_events=walls)

    def wall(self, index):
        def impact(motion, sign):
            self.last.append((motion.time, motion.state[1]))
            motion.state[1] *= -motion.pars[index]
            return True
        return impact

    def run(self, count, r_b, r_t, d):
        """The last impacts of `count`; fewer where the motion stops or falls through the wall."""
        motion, self.last = self.motion, []
        motion.reset_cooldowns()
        motion.pars[:] = (r_b, r_t, d)
        motion.time, motion.state[:] = START[0] / math.pi, (d / 2, -r_b * START[1])
        for _ in range(50 * count):
            outcome = motion.step()[0]
            if len(self.last) >= count or outcome == hy.taylor_outcome.err_nf_state or abs(motion.state[0]) > d:
                break
        return self.last


ball = Ball()
for task, walls in ONE_IMPACT.items():
    spent = seconds(lambda: ball.run(100, *walls)) / 100
    time, velocity = ball.run(100, *walls)[-1]
    say(task, "heyoka", spent, (math.fmod(math.pi * time, 2 * math.pi), velocity))


def sweep():
    ends = [ball.run(499, 0.6, 0.3, d) for d in GAPS]
    return [max(abs(velocity) for _, velocity in last[-60:]) if len(last) == 499 else math.nan for last in ends]


say("sweep", "heyoka", seconds(sweep, batches=1, least=0), sweep())
