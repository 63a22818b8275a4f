BEGIN { FS = ","; print "time_ms;m1_voltage;m2_voltage;m3_voltage;m4_voltage;m1_current_mA;m2_current_mA;m3_current_mA;m4_current_mA;m1_rpm;m2_rpm;m3_rpm;m4_rpm;cam_x_mm;cam_y_mm;yaw_deg" }
NR > 1 {
    printf "%.0f", $1 * 1000
    printf ";%.3f;%.3f;%.3f;%.3f", $2, $5, $4, $3
    printf ";%.0f;%.0f;%.0f;%.0f", $6 * 1000, $9 * 1000, $8 * 1000, $7 * 1000
    printf ";%.2f;%.2f;%.2f;%.2f", $10 * 9.5493, $13 * 9.5493, $12 * 9.5493, $11 * 9.5493
    printf ";%.1f;%.1f;%.2f\n", $14 * 1000, $15 * 1000, $16 * 57.2958
}
