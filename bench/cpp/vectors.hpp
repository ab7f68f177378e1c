// Vector operations for SUNDIALS, compiled here: Debian ships its own ones without optimisation, nine times slower.
#pragma once

#include <cmath>
#include <nvector/nvector_serial.h>

namespace vectors {

inline double* of(N_Vector x) { return NV_DATA_S(x); }
inline long size(N_Vector x) { return NV_LENGTH_S(x); }

inline void linear_sum(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
    const double *p = of(x), *q = of(y);
    double* r = of(z);
#pragma GCC ivdep
    for (long i = 0, n = size(x); i < n; ++i) r[i] = a * p[i] + b * q[i];
}

inline void constant(double c, N_Vector z) {
    double* r = of(z);
    for (long i = 0, n = size(z); i < n; ++i) r[i] = c;
}

inline void scale(double c, N_Vector x, N_Vector z) {
    const double* p = of(x);
    double* r = of(z);
#pragma GCC ivdep
    for (long i = 0, n = size(x); i < n; ++i) r[i] = c * p[i];
}

inline void absolute(N_Vector x, N_Vector z) {
    const double* p = of(x);
    double* r = of(z);
#pragma GCC ivdep
    for (long i = 0, n = size(x); i < n; ++i) r[i] = std::fabs(p[i]);
}

inline void inverse(N_Vector x, N_Vector z) {
    const double* p = of(x);
    double* r = of(z);
#pragma GCC ivdep
    for (long i = 0, n = size(x); i < n; ++i) r[i] = 1.0 / p[i];
}

inline void add_constant(N_Vector x, double b, N_Vector z) {
    const double* p = of(x);
    double* r = of(z);
#pragma GCC ivdep
    for (long i = 0, n = size(x); i < n; ++i) r[i] = p[i] + b;
}

inline double least(N_Vector x) {
    const double* p = of(x);
    double value = p[0];
    for (long i = 1, n = size(x); i < n; ++i) value = p[i] < value ? p[i] : value;
    return value;
}

inline double norm(N_Vector x, N_Vector weights) {
    const double *p = of(x), *w = of(weights);
    double sum = 0.0;
    for (long i = 0, n = size(x); i < n; ++i) sum += (p[i] * w[i]) * (p[i] * w[i]);
    return std::sqrt(sum / size(x));
}

// z = sum of c_k x_k in blocks that stay in registers; z may be x_0
inline int linear_combination(int count, double* c, N_Vector* x, N_Vector z) {
    constexpr long BLOCK = 32;
    double* r = of(z);
    const long n = size(z);
    for (long start = 0; start < n; start += BLOCK) {
        const long length = n - start < BLOCK ? n - start : BLOCK;
        double sum[BLOCK] = {};
        for (int k = 0; k < count; ++k) {
            const double* p = of(x[k]) + start;
            for (long i = 0; i < length; ++i) sum[i] += c[k] * p[i];
        }
        for (long i = 0; i < length; ++i) r[start + i] = sum[i];
    }
    return 0;
}

inline int scale_add_multi(int count, double* a, N_Vector x, N_Vector* y, N_Vector* z) {
    for (int k = 0; k < count; ++k) linear_sum(a[k], x, 1.0, y[k], z[k]);
    return 0;
}

// A vector over these numbers; its clones take the operations along.
inline N_Vector make(long size, double* data, SUNContext context) {
    N_Vector y = N_VMake_Serial(size, data, context);
    y->ops->nvlinearsum = linear_sum;
    y->ops->nvconst = constant;
    y->ops->nvscale = scale;
    y->ops->nvabs = absolute;
    y->ops->nvinv = inverse;
    y->ops->nvaddconst = add_constant;
    y->ops->nvmin = least;
    y->ops->nvwrmsnorm = norm;
    y->ops->nvlinearcombination = linear_combination;
    y->ops->nvscaleaddmulti = scale_add_multi;
    return y;
}

}  // namespace vectors
