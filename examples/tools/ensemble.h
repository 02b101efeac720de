/* ensemble.h - many runs that do not know of each other, on threads and processes

   ensemble_run calls work(k, result, user) once for each k = 0..count-1 and leaves all
   results on rank 0, in order.  How it is compiled says where they run:

     cc ...                            one after the other
     cc -fopenmp ...                   on all cores of a machine; OMP_NUM_THREADS=2: on two
     mpicc -fopenmp -DUSE_MPI ...      on the machines that mpirun is given

   What work() reads must not change, and what it writes is its result: then that is the
   same to the last bit wherever it is computed.  So stepper, array and the room of tools
   are variables of work(); a description and its effects may be shared.

   Chunks    Runs differ in length, so nobody has a fixed share.  A counter on rank 0 says
             which chunk of consecutive k comes next; each rank draws from it, rank 0 too.
             The threads of a rank share a chunk, so it holds several times as many runs
             as a rank has threads, and a hundredth of all at most, or 1.
   Waiting   A rank asks for its next chunk before it begins the one that it has: where
             rank 0 answers between its own chunks only, nobody stands idle.
   Gathering A result is any plain structure without pointers.  Each is zero but on the
             rank that computed it, so bitwise or leaves every bit as it is.
             count*size < 2^31.

   Use    rank = ensemble_begin(&argc, &argv);           every process; 0 without MPI
          ensemble_run(count, chunk, sizeof result[0], work, user, result);
          if (rank == 0) ...                             result[0..count-1] are there
          ensemble_end();                                                           */
#ifndef ENSEMBLE_H
#define ENSEMBLE_H
#if defined __cplusplus && defined __GNUC__
#pragma GCC system_header          /* C++ would warn of fields that an initialiser does not name */
#endif

#include <stdio.h>
#include <string.h>
#include <time.h>
#ifdef USE_MPI
#include <mpi.h>
#endif

typedef void ensemble_fn(int k, void *result, void *user);

typedef struct ensemble_counter {
    int chunk, next;                     // the answer, once it is there
    int rank;
#ifdef USE_MPI
    MPI_Win     window;                  // on rank 0's counter
    MPI_Request asked;
#endif
} ensemble_counter;

#ifdef USE_MPI

static inline int ensemble_begin(int *argc, char ***argv)
{
    int rank, level;
    MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &level);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return rank;
}

static inline void ensemble_end(void) { MPI_Finalize(); }

static inline void ensemble_open(ensemble_counter *c)
{
    int *counter;
    MPI_Comm_rank(MPI_COMM_WORLD, &c->rank);
    MPI_Win_allocate(c->rank ? 0 : sizeof *counter, sizeof *counter, MPI_INFO_NULL, MPI_COMM_WORLD,
                     &counter, &c->window);
    MPI_Win_lock_all(0, c->window);
    if (c->rank == 0) {
        *counter = 0;
        MPI_Win_sync(c->window);
    }
    MPI_Barrier(MPI_COMM_WORLD);
}

static inline void ensemble_ask(ensemble_counter *c)
{
    MPI_Rget_accumulate(&c->chunk, 1, MPI_INT, &c->next, 1, MPI_INT, 0, 0, 1, MPI_INT, MPI_SUM,
                        c->window, &c->asked);
}

static inline int ensemble_answer(ensemble_counter *c)
{
    MPI_Wait(&c->asked, MPI_STATUS_IGNORE);
    return c->next;
}

static inline void ensemble_gather(ensemble_counter *c, int bytes, void *results)
{
    MPI_Win_unlock_all(c->window);
    MPI_Win_free(&c->window);
    MPI_Reduce(c->rank ? results : MPI_IN_PLACE, results, bytes, MPI_BYTE, MPI_BOR, 0, MPI_COMM_WORLD);
}

#else

static inline int ensemble_begin(int *argc, char ***argv) { return (void)argc, (void)argv, 0; }
static inline void ensemble_end(void) { }
static inline void ensemble_open(ensemble_counter *c) { c->next = -c->chunk; }
static inline void ensemble_ask(ensemble_counter *c) { (void)c; }
static inline int ensemble_answer(ensemble_counter *c) { return c->next += c->chunk; }
static inline void ensemble_gather(ensemble_counter *c, int bytes, void *results)
{
    (void)c, (void)bytes, (void)results;
}

#endif

/* A line that stands still on a terminal, from the third second on.             */
static inline void ensemble_progress(int done, int count, time_t begin, time_t *shown)
{
    const time_t now = time(NULL);
    const double since = difftime(now, begin);
    if (difftime(now, *shown) < 1 || since < 3) return;
    *shown = now;
    fprintf(stderr, "\r%d of %d, %.0f s, about %.0f s to go ", done, count, since, since*(count - done)/done);
}

static inline void ensemble_run(int count, int chunk, size_t size, ensemble_fn *work, void *user, void *results)
{
    const time_t begin = time(NULL);
    time_t shown = begin;
    if (chunk < 1) chunk = 1;
    if (count < 0) count = 0;
    ensemble_counter c = { .chunk = chunk };
    int first;
    memset(results, 0, (size_t)count*size);
    ensemble_open(&c);
    ensemble_ask(&c);
    while ((first = ensemble_answer(&c)) < count) {
        const int end = count - first < chunk ? count : first + chunk;
        ensemble_ask(&c);
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic)
#endif
        for (int k = first; k < end; ++k) work(k, (char *)results + (size_t)k*size, user);
        if (c.rank == 0) ensemble_progress(end, count, begin, &shown);
    }
    ensemble_gather(&c, (int)((size_t)count*size), results);
    if (c.rank == 0 && difftime(shown, begin) > 0) fprintf(stderr, "\n");
}

#endif
