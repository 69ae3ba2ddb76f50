"""The static equilibrium of a geometrically exact rod as an initial value problem along its axis [Antman, Nonlinear
Problems of Elasticity, chapter 8]: n' = -load, m' = -r' x n, strains from forces by the section's compliance. Written
over any numbers, so that the same lines serve double precision and many digits. Nothing of it is a finite element."""

from mpmath import mp, mpf


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def matrix(q):
    """The rotation of a unit quaternion (w, x, y, z), by rows."""
    w, x, y, z = q
    return [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]


def product(p, q):
    """Of two quaternions."""
    a, b, c, d = p
    w, x, y, z = q
    return [
        a * w - b * x - c * y - d * z,
        a * x + b * w + c * z - d * y,
        a * y - b * z + c * w + d * x,
        a * z + b * y - c * x + d * w,
    ]


def compliance(stiffness):
    """The inverse of a section's stiffness: six numbers or 6 x 6, in many digits."""
    if not isinstance(stiffness[0], (list, tuple)):
        return [1 / mpf(value) for value in stiffness]
    inverse = mp.matrix([[mpf(value) for value in row] for row in stiffness]) ** -1
    return [[inverse[i, j] for j in range(6)] for i in range(6)]


def as_floats(values):
    return [as_floats(v) if isinstance(v, (list, tuple)) else float(v) for v in values]


def slope(soft, force, curvature):
    """The right-hand side over (r, q, m): `soft` compliance, `force` n, constant along the rod and in space,
    `curvature` of the unstressed rod at s, in the section's axes."""
    full = isinstance(soft[0], (list, tuple))

    def rate(s, y):
        q, m = y[3:7], y[7:10]
        R = matrix(q)
        n_body = [R[0][k] * force[0] + R[1][k] * force[1] + R[2][k] * force[2] for k in range(3)]
        m_body = [R[0][k] * m[0] + R[1][k] * m[1] + R[2][k] * m[2] for k in range(3)]
        stress = n_body + m_body
        if full:
            strain = [sum(row[k] * stress[k] for k in range(6) if row[k] != 0) for row in soft]
        else:
            strain = [c * f for c, f in zip(soft, stress)]
        g = [1 + strain[0], strain[1], strain[2]]
        k0 = curvature(s)
        k = [strain[3 + i] + k0[i] for i in range(3)]
        r = [R[i][0] * g[0] + R[i][1] * g[1] + R[i][2] * g[2] for i in range(3)]
        turn = product(q, [0, k[0], k[1], k[2]])
        moment = cross(force, r)
        return r + [value / 2 for value in turn] + moment

    return rate


def straight(_):
    return (0, 0, 0)
