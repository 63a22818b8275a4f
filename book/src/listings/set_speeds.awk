# Set speeds of four wheels (plus layout, 0.09 m, radius 0.03 m): smooth motion on three axes, with rests; seed picks the phases.
BEGIN {
    print "t_s,wset0_rad_s,wset1_rad_s,wset2_rad_s,wset3_rad_s"
    for (n = 0; n < 1000; n++) {
        t = n * 0.01
        awake = sin(0.6 * t + seed); awake = awake < 0 ? 0 : awake
        v = 0.6 * awake * sin(1.7 * t + 2 * seed); vn = 0.6 * awake * sin(2.3 * t + 3 * seed); w = 4 * awake * sin(1.1 * t + seed)
        printf "%.2f,%.3f,%.3f,%.3f,%.3f\n", t, (vn + 0.09 * w) / 0.03, (-v + 0.09 * w) / 0.03, (-vn + 0.09 * w) / 0.03, (v + 0.09 * w) / 0.03
    }
}
