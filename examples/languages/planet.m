% planet.m - the planet of the README in MATLAB and Octave; see gvi_run.c
%
% prints
%
% ok: q = -0.602737580 0.799997002
force = @(t, q) -q./(sum(q.^2, 2).^1.5);
[q, p, why] = gvi_run(force, [0.4 0], [0 2], 0.1, 10000, 8);
fprintf('%s: q = %.9f %.9f\n', why, q(end, 1), q(end, 2));
