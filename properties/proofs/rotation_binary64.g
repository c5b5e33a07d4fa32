# The rotations of bench/pivot (rotation.h, rotated_chain.h) in binary64, u = 2^-53, by components.
#
# Proved, for quaternions of length 1 but for 2^-30 and whatever they turn no longer than 1:
# 1. a component of a vector turned is wrong by at most 55u, so a vector by less than 96u;
# 2. a component of a product of two quaternions is wrong by at most 13u, so the product by at most 26u;
# 3. normalised() leaves a length of 1 but for 6u;
# 4. a place down 31 levels is wrong by less than 2^17 u times the extent, and a move changes the distance of two spheres
#    that it turns alike by less than drift = 2^-33 of the extent;
# 5. rounding to binary32 and 4. together change the distance of two spheres by less than rounding = 2^-22 of the extent.
# Components of axis x v + w v are at most 1: axis x v is orthogonal to v, so its length is at most that of v.

@r = float<ieee_64, ne>;

# 1. One component of axis x v + w v (each is like this one), then of v + 2 axis x t, the t with their errors.
t r= (y * vz - z * vy) + w * vx;
T = (y * vz - z * vy) + w * vx;
turned r= vx + 2 * (y * tz - z * ty);
Turned = vx + 2 * (y * Tz - z * Ty);

# 2.
p r= w * bw - x * bx - y * by - z * bz;
P = w * bw - x * bx - y * by - z * bz;

# 3. Relative errors: of the sum of squares, of the root, of the quotient, of the product.
scaled = (1 + e4) / (sqrt(1 + e1) * (1 + e2)) * (1 + e3);

# 4. Level k has k <= 31 products (496 in all), each 52u with what it turns and 24u from the lengths, and one rotation, of steps of at most 2 E;
# four such places, and as much again for what is stored.
place = 2 * (76 * 496 + 31 * 96) * 1b-53;
moved = 8 * place;

# 5.
written = 2 * root3 * 1b-24 + 8 * place;

{ |x| <= 1.000001 /\ |y| <= 1.000001 /\ |z| <= 1.000001 /\ |w| <= 1.000001
   /\ |bx| <= 1.000001 /\ |by| <= 1.000001 /\ |bz| <= 1.000001 /\ |bw| <= 1.000001
   /\ |vx| <= 1 /\ |vy| <= 1 /\ |vz| <= 1
   /\ |Ty| <= 1.00001 /\ |Tz| <= 1.00001 /\ |ty - Ty| <= 8b-53 /\ |tz - Tz| <= 8b-53
   /\ |e1| <= 5b-53 /\ |e2| <= 1b-53 /\ |e3| <= 1b-53 /\ |e4| <= 1b-53
   /\ root3 in [1.732, 1.7320509]
  -> |t - T| <= 8b-53 /\ |turned - Turned| <= 55b-53
  /\ |p - P| <= 13b-53
  /\ |scaled - 1| <= 6b-53
  /\ place <= 131072b-53 /\ moved <= 1b-33
  /\ written <= 1b-22 }
