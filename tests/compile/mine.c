/* What `make mycost FILE=tests/compile/mine.c` reads, of docs/tools.md */
LAGRANGIAN(mine, 2)
{
    const double g = 9.81;
    return v[0]*v[0] + v[1]*v[1]/2 + v[0]*v[1]*cos(q[0] - q[1]) + 2*g*cos(q[0]) + g*cos(q[1]);
}
static const double mine_q[] = { 0.8, 0.5 }, mine_v[] = { 0, 0 };
static const double mine_horizon = 5, mine_h = 0.1;
