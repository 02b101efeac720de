/* planet.rs - gvi.h from Rust: the structures by hand, one function for the forces

    cc -O2 -DGVI_IMPLEMENTATION -xc -c gvi.h -o gvi.o && ar rcs libgvi.a gvi.o
    rustc -O planet.rs -L . -l static=gvi -l m

prints

ok: q = -0.602737580 0.799997002
*/
use std::ffi::{c_char, c_int, c_void, CStr};
use std::ptr::{null, null_mut};

#[repr(C)]
struct Points {
    n: c_int, count: c_int, stride: c_int,
    t: *const f64, q: *const f64, v: *const f64, p: *const f64,
    f: *mut f64, dldv: *mut f64, value: *mut f64, mass: *mut f64, velocity: *mut f64,
    g: *mut f64, jacobian: *mut f64, rate: *mut f64,
}
type PointsFn = extern "C" fn(*const Points, *mut c_void) -> c_int;

#[repr(C)]
struct Effect {
    kind: c_int, points: Option<PointsFn>, point: *const c_void, value: Option<PointsFn>,
    hessian: *const c_void, user: *mut c_void, rows: c_int,
}

#[repr(C)]
struct Rule { kind: c_int, points: c_int, nodes: *const f64, weights: *const f64 }

#[repr(C)]
struct Mass {
    kind: c_int, matrix: *const f64, points: Option<PointsFn>, gradient: Option<PointsFn>,
    velocity: Option<PointsFn>, user: *mut c_void,
}

#[repr(C)]
struct Desc {
    n: c_int, degree: c_int, rule: Rule, mass: Mass, effects: *const Effect, effect_count: c_int,
    formulation: c_int, tolerance: f64, max_iterations: c_int, iterations: c_int,
    later: [f64; 8],                                // what later versions add: zeros
}

/* the first fields; gvi_stepper_size() bytes in all */
#[repr(C)]
struct Stepper {
    n: c_int, s: c_int, r: c_int, status: c_int, formulation: c_int, t: f64, t_low: f64,
    q: *const f64, p: *const f64,
}

extern "C" {
    fn gvi_size(desc: *const Desc) -> usize;
    fn gvi_stepper_size() -> usize;
    fn gvi_init(st: *mut Stepper, desc: *const Desc, memory: *mut f64, size: usize) -> c_int;
    fn gvi_start(st: *mut Stepper, t: f64, q: *const f64, v: *const f64) -> c_int;
    fn gvi_step(st: *mut Stepper, h: f64) -> c_int;
    fn gvi_why(st: *const Stepper) -> *const c_char;
}

extern "C" fn attraction(x: *const Points, _user: *mut c_void) -> c_int {
    unsafe {
        let x = &*x;
        let (count, stride) = (x.count as usize, x.stride as usize);
        let q = std::slice::from_raw_parts(x.q, 2*stride);
        let f = std::slice::from_raw_parts_mut(x.f, 2*stride);
        for k in 0..count {
            let d2 = q[k]*q[k] + q[stride + k]*q[stride + k];
            let w = -1.0/(d2*d2.sqrt());
            f[k] += w*q[k];
            f[stride + k] += w*q[stride + k];
        }
    }
    0
}

fn main() {
    unsafe {
        let effects = [Effect { kind: 0, points: Some(attraction), point: null(), value: None,
                                hessian: null(), user: null_mut(), rows: 0 }];
        let mut desc: Desc = std::mem::zeroed();
        desc.n = 2;
        desc.degree = 8;
        desc.effects = effects.as_ptr();
        desc.effect_count = 1;
        let size = gvi_size(&desc);
        let mut memory = vec![0f64; size/8 + 1];
        let mut stepper = vec![0f64; gvi_stepper_size()/8 + 1];
        let st = stepper.as_mut_ptr() as *mut Stepper;
        gvi_init(st, &desc, memory.as_mut_ptr(), size);
        gvi_start(st, 0.0, [0.4, 0.0].as_ptr(), [0.0, 2.0].as_ptr());
        for _ in 0..10000 {
            if (*st).status != 0 { break; }
            gvi_step(st, 0.1);
        }
        println!("{}: q = {:.9} {:.9}", CStr::from_ptr(gvi_why(st)).to_str().unwrap(), *(*st).q, *(*st).q.add(1));
    }
}
