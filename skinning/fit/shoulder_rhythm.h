// The scapulohumeral rhythm: how the shoulder girdle rises with the arm.
#pragma once

namespace chironomia {

struct ShoulderRhythm {
    float setting = 0.5236f;  // up to this elevation of the arm the girdle stays; 30 degrees [radians]
    float slope = 0.123f;     // how far the clavicle rises for each radian of the arm above it
};

// How far the clavicle rises at its inner end when the arm is raised to `elevation`, both against the trunk: 0 for a
// hanging arm, pi for one straight up [radians]. Inman, Saunders and Abbott, "Observations on the Function of the
// Shoulder Joint", J. Bone Joint Surg. 26(1), 1944: the girdle does not turn much in the first 30 degrees, above them
// 1 degree for each 2 of the upper arm in its socket. That degree is the scapula's. Of it an avatar has the clavicle
// alone, whose elevation de Groot and Brand, "A three-dimensional regression model of the shoulder rhythm", Clin.
// Biomech. 16(9), 2001, found to be 0.123 degrees for each degree of the arm; the coefficient is as given in the
// Dynamic Arm Simulator's `shoulder_regression` (Chadwick et al., 2014). So an arm straight up lifts it by 18 degrees.
// We differ: the share of the plane in which the arm is raised (0.046) and the retraction of the clavicle are left
// out, since the line between the shoulders is seen.
float clavicle_elevation(float elevation, const ShoulderRhythm& rhythm = {});

}  // namespace chironomia
