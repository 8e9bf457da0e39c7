/* The protocol of docs/own-tracer.md in C: one loop over all spheres for each ray, in double. On a little-endian machine:
   cc -O2 -ffp-contract=off -o tracer tracer.c -lm */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static void *more(size_t bytes) {
    void *memory = malloc(bytes + 1);
    if (!memory || fread(memory, 1, bytes, stdin) != bytes) exit(1);
    return memory;
}

int main(void) {
    struct { uint32_t magic, version, n, width, height; } head;
    while (fread(&head, sizeof head, 1, stdin) == 1) {
        if (head.magic != 0x51544743 /* CGTQ */ || head.version != 1) return 1;
        size_t m = (size_t)head.width * head.height;
        float *camera = more(48), *ray = more(24 * m), *t = malloc(4 * m);
        uint32_t *id = malloc(4 * m);
        if (!t || !id) return 1;
        putchar('r'), fflush(stdout), getchar();
        float *sphere = more(16 * (size_t)head.n);
        for (size_t k = 0; k < m; k++) {
            const float *e = ray + 6 * k, *d = e + 3;
            double a = (double)d[0] * d[0] + (double)d[1] * d[1] + (double)d[2] * d[2], nearest = INFINITY;
            id[k] = UINT32_MAX;
            for (uint32_t i = 0; i < head.n && a > 0; i++) {
                const float *c = sphere + 4 * (size_t)i;
                double f[3] = {(double)e[0] - c[0], (double)e[1] - c[1], (double)e[2] - c[2]};
                double b = f[0] * d[0] + f[1] * d[1] + f[2] * d[2];
                double q = f[0] * f[0] + f[1] * f[1] + f[2] * f[2] - (double)c[3] * c[3], D = b * b - a * q;
                double s = sqrt(D), x = (-b - s) / a > 0 ? (-b - s) / a : (-b + s) / a; /* NaN, where D < 0, is no hit */
                if (x > 0 && x < nearest) nearest = x, id[k] = i;
            }
            t[k] = (float)nearest;
        }
        putchar('d'), fwrite(id, 4, m, stdout), fwrite(t, 4, m, stdout), fflush(stdout);
        free(camera), free(sphere), free(ray), free(t), free(id);
    }
    return 0;
}
