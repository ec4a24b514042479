% Octave: ode45 with events for impacts, fsolve for the orbit, fzero for the period doubling.
1;
warning("off", "all"); % ode45 warns at every event
function say(task, tool, seconds, answers)
  printf("%s\t%s\t%.6e\t%s\n", task, tool, seconds, strjoin(arrayfun(@(x) sprintf("%.17g", x), answers, "UniformOutput", false), ";"));
end

function s = seconds_of(job, repeats)
  s = Inf;
  for batch = 1:3
    start = cputime; for i = 1:repeats, job(); end
    s = min(s, (cputime - start) / repeats);
  end
end

function [value, stop, direction] = walls(t, x, d)
  value = [x(1) - d/2; x(1) + d/2]; stop = [1; 1]; direction = [1; -1];
end

function answer = impacts(count, r_b, r_t, d)
  options = odeset("RelTol", 1e-10, "AbsTol", 1e-12, "Events", @(t, x) walls(t, x, d));
  t = 6.18/pi; side = 1; velocity = 0.5293;
  for i = 1:count
    r = r_b; if side < 0, r = r_t; end
    [~, ~, te, xe, ie] = ode45(@(t, x) [x(2); cos(pi*t) + 0.12201], [t, t + 20], [side*d/2; -r*velocity], options);
    t = te(end); velocity = xe(end, 2); side = 3 - 2*ie(end);
  end
  answer = [mod(pi*t, 2*pi), velocity];
end

function [res, v, w] = balance(x, d)
  g = 0.12201; r = 0.5; p = x(1); t1 = x(2); t2 = 2 - t1; q = p + pi*t1;
  rise = g*t1 + (sin(q) - sin(p))/pi; v = (2*g - (1 + r)*rise)/(1 - r*r); w = rise - r*v;
  res = [t1*(g*t1/2 - r*v - sin(p)/pi) - (cos(q) - cos(p))/pi^2 + d; t2*(g*t2/2 - r*w - sin(q)/pi) - (cos(p) - cos(q))/pi^2 - d];
end

function x = orbit(guess, d)
  x = fsolve(@(x) balance(x, d), guess, optimset("TolX", 1e-13, "TolFun", 1e-15));
end

function answer = whole()
  x = orbit([0.95*0.4893951147; 1.05*1.1165006593], 0.4);
  [~, v, w] = balance(x, 0.4); answer = [x(2), v, w];
end

function value = above_doubling(near, d)
  x = orbit(near, d); [~, v, w] = balance(x, d); r = 0.5; t1 = x(2); t2 = 2 - t1;
  a = 0.12201 + cos(x(1)); b = 0.12201 + cos(x(1) + pi*t1);
  first = [(a*t1 - r*v)/w, r*t1/w]; first = [first; b*first - [a, r]];
  second = [(b*t2 - r*w)/v, r*t2/v]; second = [second; a*second - [b, r]];
  value = trace(second*first) + 1 + r^4;
end

function d = doubling()
  near = orbit([0.14811268; 1.31700614], 0.26);
  d = fzero(@(d) above_doubling(near, d), [0.245, 0.26], optimset("TolX", 1e-11));
end

for row = {"impact-focus", 0.5, 0.5, 0.4; "impact-three", 0.6, 0.3, 0.26}'
  start = cputime; answer = impacts(100, row{2:4}); spent = (cputime - start)/100;
  say(row{1}, "Octave ode45", spent, answer);
end
say("orbit", "Octave fsolve", seconds_of(@whole, 5), whole());
say("doubling", "Octave fzero + fsolve", seconds_of(@doubling, 2), doubling());
