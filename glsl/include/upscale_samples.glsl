// Samples of this frame around pixels of the output, for temporal_upscale: an invocation has a column of pixels, which have most of their
// samples in common. Needs the bindings `radiance_0`, `radiance_1` and `albedo`, `depth_at`, SHOWN, `tone_curve` and `exposure` in the block
// `push`, optional.glsl, viewport.glsl and demodulation.glsl.
#ifndef UPSCALE_SAMPLES_GLSL
#define UPSCALE_SAMPLES_GLSL

// Pixels of the output, and rows with their samples.
const int COLUMN = 2;
const int ROWS = COLUMN + 2;

// Sharpness of the Gaussian of samples of a first picture, by squared rendered pixels.
const float SHARPNESS = 2.29;
// That of one with a past, by the product of distances in rendered pixels and in those of the output.
const float LATER_SHARPNESS = 4.58;
// That of the light around and of the box which clips the past, by squared rendered pixels.
const float BOX_SHARPNESS = 0.5;
// Share of the first one's that every later picture has, since few pixels of the output have a sample close by.
const float LEAST_SHARE = 1e-3;
// Light of the filter that is as good as none: with it nothing is divided by 0.
const float DARKNESS = 0.01;
// Beyond any light, so that sums and quotients are finite.
const float BRIGHTEST_SAMPLE = 1e30;
// Beyond any depth.
const float NOWHERE = 3e38;

vec3 ycocg(vec3 c) { return vec3(dot(c, vec3(0.25, 0.5, 0.25)), dot(c, vec3(0.5, 0.0, -0.5)), dot(c, vec3(-0.25, 0.5, -0.25))); }
vec3 rgb(vec3 c) { return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z); }

// As ToneCurve in src/contract/tuning.rs.
const uint CURVE_ACES = 0u;
const uint CURVE_LINEAR = 2u;
// The curve of ACES is so much steeper in the dark than x/(1 + x).
const float ACES_STEEPNESS = 4.0;

// From the filter's exposure to that of the display.
float display_exposure() { return SHOWN ? push.exposure * frame.inverse_filter_exposure : 1.0; }

float steepness() {
    float shown = push.tone_curve == CURVE_LINEAR ? 0.0 : display_exposure() * (push.tone_curve == CURVE_ACES ? ACES_STEEPNESS : 1.0);
    return SHOWN ? shown : 1.0;
}

// What a curve without a shoulder shows as white is as bright as all beyond: an edge of a lamp would stay jagged.
float brightest_sample() { return SHOWN && push.tone_curve == CURVE_LINEAR ? min(1.0 / display_exposure(), BRIGHTEST_SAMPLE) : BRIGHTEST_SAMPLE; }

// A bright sample counts less [Karis 2014]: as if means were taken of c/(1 + luminance).
float evenness(vec3 c) { return 1.0 / (1.0 + steepness() * luminance(c)); }

// What a colour counts in means: of radiance they are those of the pixel, or edges of lamps would lose their light.
float share_of(vec3 c) { return SHOWN ? evenness(c) : 1.0; }

struct Sample {
    vec3 radiance;    // in the filter's exposure
    vec3 irradiance;
    float depth;      // NOWHERE: background
};

Sample sample_at(ivec2 q) {
    vec3 radiance = texelFetch(radiance_0, host_pixel(RADIANCE_0, q), 0).rgb;
    if (is_present(RADIANCE_1)) radiance += texelFetch(radiance_1, host_pixel(RADIANCE_1, q), 0).rgb;
    Sample s;
    s.radiance = clamp(exposed(radiance), 0.0, brightest_sample());
    s.irradiance = clamp(exposed(radiance), 0.0, BRIGHTEST_SAMPLE);
    float depth = depth_at(q);
    if (is_present(ALBEDO) && depth > 0.0) s.irradiance /= divisor_of(texelFetch(albedo, host_pixel(ALBEDO, q), 0).rgb);
    s.depth = depth > 0.0 ? depth : NOWHERE;
    return s;
}

struct Neighbourhood {
    vec4 first, later;     // colour times its share, and the share: for a first picture and for one with a past
    float weight;          // of the samples of the later one
    vec3 light;            // irradiance around
    vec3 mean, deviation;  // YCoCg of colours times evenness
    ivec2 nearest;         // pixel of the nearest surface
    float depth;           // its depth; 0: background alone
};

// Position of a pixel of the output among rendered pixels.
vec2 rendered_position(ivec2 p) { return (vec2(p) + 0.5) * extent_ratio(frame.output_extent, frame.render_extent); }

// The rendered pixel whose sample is the nearest one.
ivec2 nearest_sample(ivec2 p) { return ivec2(floor(rendered_position(p) - frame.jitter)); }

// What a sample weighs along one axis.
struct Weight {
    float first, later, box;
};

// Of the sample of pixel q for a pixel at `centre`, whose nearest sample is that of `middle`. `scale`: pixels of the output in a rendered one.
Weight weight_of(int q, int middle, float centre, float jitter, float scale, int extent) {
    float d = float(middle) + 0.5 + jitter - centre + float(q - middle), narrow = d * scale;
    float counts = abs(q - middle) <= 1 && q >= 0 && q < extent ? 1.0 : 0.0;
    // Others would bring the radiance of a lamp beside the pixel into it.
    float later = SHOWN || q == middle ? counts * exp(-LATER_SHARPNESS * d * narrow) : 0.0;
    return Weight(counts * exp(-SHARPNESS * d * d), later, counts * exp(-BOX_SHARPNESS * d * d));
}

// Weighted sums over samples.
struct Sums {
    vec4 first, later, light;
    vec3 mean, square;
    Weight total;
    float depth;    // the least
    ivec2 nearest;  // its pixel
};

Sums no_sums(ivec2 nearest) {
    return Sums(vec4(0.0), vec4(0.0), vec4(0.0), vec3(0.0), vec3(0.0), Weight(0.0, 0.0, 0.0), NOWHERE, nearest);
}

void add(inout Sums sums, Weight w, Sums of) {
    sums.first += w.first * of.first;
    sums.later += w.later * of.later;
    sums.light += w.box * of.light;
    sums.mean += w.box * of.mean;
    sums.square += w.box * of.square;
    sums.total.first += w.first * of.total.first;
    sums.total.later += w.later * of.total.later;
    sums.total.box += w.box * of.total.box;
    bool nearer = w.box > 0.0 && of.depth < sums.depth;
    sums.nearest = nearer ? of.nearest : sums.nearest;
    sums.depth = nearer ? of.depth : sums.depth;
}

// One sample, its moments around a pivot.
Sums sums_of(ivec2 q, vec3 pivot) {
    Sample s = sample_at(q);
    vec4 counted = vec4(s.radiance, 1.0) * share_of(s.radiance);
    vec3 c = ycocg(s.radiance * evenness(s.radiance)) - pivot;
    vec4 light = vec4(s.irradiance, 1.0) / (1.0 + luminance(s.irradiance));
    return Sums(counted, counted, light, c, c * c, Weight(1.0, 1.0, 1.0), s.depth, q);
}

Neighbourhood neighbourhood(Sums sums, vec3 pivot) {
    Neighbourhood around;
    around.nearest = sums.nearest;
    around.depth = sums.depth == NOWHERE ? 0.0 : sums.depth;
    around.first = sums.first / sums.total.first;
    around.weight = sums.total.later;
    around.later = (sums.later + LEAST_SHARE * around.first) / (around.weight + LEAST_SHARE);
    // Means of a display have white in them, by which no light divides.
    around.light = SHOWN ? vec3(1.0) : sums.light.rgb / sums.light.a + DARKNESS;
    float share = 1.0 / sums.total.box;
    vec3 mean = sums.mean * share;
    around.deviation = sqrt(max(sums.square * share - mean * mean, 0.0));
    around.mean = mean + pivot;
    return around;
}

// Of a column of pixels of the output. Row by row: a row's sums are those of each pixel that it is near to.
void gather(ivec2 top, out Neighbourhood around[COLUMN]) {
    vec2 scale = extent_ratio(frame.render_extent, frame.output_extent);
    ivec2 extent = ivec2(frame.render_extent), middle = nearest_sample(top);
    // Moments around one of the colours of every pixel: the difference of squares would cancel otherwise.
    vec3 pivot = sample_at(nearest_inside(middle)).radiance;
    pivot = ycocg(pivot * evenness(pivot));
    Weight across[3];
    [[unroll]] for (int x = 0; x < 3; ++x)
        across[x] = weight_of(middle.x + x - 1, middle.x, rendered_position(top).x, frame.jitter.x, scale.x, extent.x);
    Sums sums[COLUMN];
    [[unroll]] for (int k = 0; k < COLUMN; ++k) sums[k] = no_sums(nearest_inside(nearest_sample(top + ivec2(0, k))));
    [[unroll]] for (int y = 0; y < ROWS; ++y) {
        Sums row = no_sums(ivec2(0));
        [[unroll]] for (int x = 0; x < 3; ++x) add(row, across[x], sums_of(nearest_inside(middle + ivec2(x, y) - 1), pivot));
        [[unroll]] for (int k = 0; k < COLUMN; ++k) {
            // A pixel of the output is no larger than a rendered one.
            if (y > k + 2) continue;
            ivec2 p = top + ivec2(0, k);
            add(sums[k], weight_of(middle.y + y - 1, nearest_sample(p).y, rendered_position(p).y, frame.jitter.y, scale.y, extent.y), row);
        }
    }
    [[unroll]] for (int k = 0; k < COLUMN; ++k) around[k] = neighbourhood(sums[k], pivot);
}

#endif
