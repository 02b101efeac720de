/* gvi_run.c - gvi.h from MATLAB and Octave: one function, by MEX

     mex -I. examples/languages/gvi_run.c                      (MATLAB)
     mkoctfile --mex -I. examples/languages/gvi_run.c          (Octave)

   [q, p, why] = gvi_run(force, q0, v0, h, steps, degree)

   force   handle: f = force(t, q) for all points of a step at once, t [points x 1], q and f [points x n]
   q, p    [steps x n], the state after each step; unit masses
   why     'ok', or what went wrong: rows after it are NaN                                     */
#define GVI_STATIC
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "mex.h"
#include <stdlib.h>
#include <string.h>

// the library's rows are the columns of MATLAB's arrays, but for the stride
static int from_matlab(const gvi_points *x, void *user)
{
    mxArray *in[3] = { (mxArray *)user, mxCreateDoubleMatrix((size_t)x->count, 1, mxREAL),
                       mxCreateDoubleMatrix((size_t)x->count, (size_t)x->n, mxREAL) };
    mxArray *out = NULL;
    memcpy(mxGetPr(in[1]), x->t, (size_t)x->count*sizeof(double));
    for (int i = 0; i < x->n; ++i)
        memcpy(mxGetPr(in[2]) + i*x->count, x->q + i*x->stride, (size_t)x->count*sizeof(double));
    int failed = mexCallMATLAB(1, &out, 3, in, "feval");
    failed |= !out || mxGetNumberOfElements(out) != (size_t)(x->n*x->count);
    for (int i = 0; !failed && i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] += mxGetPr(out)[i*x->count + k];
    mxDestroyArray(in[1]);
    mxDestroyArray(in[2]);
    if (out) mxDestroyArray(out);
    return failed;
}

void mexFunction(int results, mxArray *out[], int arguments, const mxArray *in[])
{
    if (arguments != 6) mexErrMsgTxt("gvi_run(force, q0, v0, h, steps, degree)");
    const int n = (int)mxGetNumberOfElements(in[1]), steps = (int)mxGetScalar(in[4]);
    const gvi_effect effect = { .kind = GVI_POTENTIAL, .points = from_matlab, .user = (void *)in[0] };
    const gvi_desc desc = { .n = n, .degree = (int)mxGetScalar(in[5]), .effects = &effect, .effect_count = 1 };
    double *memory = (double *)malloc(gvi_size(&desc) + sizeof(double));
    gvi_stepper st;
    if (mxGetNumberOfElements(in[2]) != (size_t)n) mexErrMsgTxt("q0 and v0 differ in length");
    out[0] = mxCreateDoubleMatrix((size_t)steps, (size_t)n, mxREAL);
    mxArray *p = mxCreateDoubleMatrix((size_t)steps, (size_t)n, mxREAL);
    gvi_init(&st, &desc, memory, gvi_size(&desc));
    gvi_start(&st, 0, mxGetPr(in[1]), mxGetPr(in[2]));
    for (int k = 0; k < steps; ++k) {
        if (st.status == GVI_OK) gvi_step(&st, mxGetScalar(in[3]));
        for (int i = 0; i < n; ++i) {
            mxGetPr(out[0])[i*steps + k] = st.status == GVI_OK ? st.q[i] : mxGetNaN();
            mxGetPr(p)[i*steps + k] = st.status == GVI_OK ? st.p[i] : mxGetNaN();
        }
    }
    if (results > 1) out[1] = p;
    if (results > 2) out[2] = mxCreateString(gvi_why(&st));
    free(memory);
}
