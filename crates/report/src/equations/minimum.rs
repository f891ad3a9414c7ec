//! Section VIII, solution 1: eqs. (i)-(x).

equations! {
    "(i)" "Measured downwards, the three bars together reach from O to D. (The text says OD = l; this line, and all results, need OD = 2l.)"
        r"l\cos\theta + l\cos\alpha + l\cos\beta = 2l";
    "(ii)" "Measured sideways, they come back to the vertical through O."
        r"l\sin\theta + l\sin\alpha + l\sin\beta = 0";
    "(iii)" "(i) without the common length."
        r"\cos\theta + \cos\alpha + \cos\beta = 2";
    "(iv)" "(ii) without the common length."
        r"\sin\theta + \sin\alpha + \sin\beta = 0";
    "(v)" "The energy of the three weights: each bar carries the centres of those below it down. Heights count from D."
        r"V = mgl\,(6 - 2.5\cos\theta - 1.5\cos\alpha - 0.5\cos\beta)";
    "(vi)" "The same on closed chains, β eliminated by (iii)."
        r"V = mgl\,(5 - 2\cos\theta - \cos\alpha)";
    "(vii)" "(iii) and (iv) solved for β. It carries the number (viii), which the next one has too; the one missing is (vii)."
        r"\cos\beta = 2 - \cos\theta - \cos\alpha, \quad \sin\beta = -\sin\theta - \sin\alpha \qquad \wrong{\text{(viii)}}"
        => r"\cos\beta = 2 - \cos\theta - \cos\alpha, \quad \sin\beta = -\sin\theta - \sin\alpha \qquad \fixed{\text{(vii)}}";
    "(viii)" "For a given θ a quadratic in cos α: (vii) squared and summed, and squared once more to be rid of sin α. So it has four solutions α, of which two close the chain."
        r"(20 - 16\cos\theta){\cos}^2\,\alpha + 2(26\cos\theta - 20 - 8{\cos}^2\,\theta)\cos\alpha + 16{\cos}^2\,\theta + 25 - 40\cos\theta - 4{\sin}^2\,\theta = 0";
    "(ix)" "The first position. The angles are the best point of a grid with the step 0.001 rad, not of the minimum between its points; V is right to all its digits because it is flat there."
        r"\wrong{\theta = 19.70975^\circ, \quad \alpha = 38.58306^\circ, \quad \beta = 286.07420^\circ,} \quad V = 2.33547\,mgl"
        => r"\fixed{\theta = 19.69487^\circ, \quad \alpha = 38.59914^\circ, \quad \beta = 286.07941^\circ,} \quad V = 2.33547\,mgl";
    "(x)" "The second position. It is no equilibrium but the first point of the same grid on the other branch of (viii), on a slope. What there is instead is the first position upside down, which no search for minima finds."
        r"\wrong{\theta = 0.05730^\circ, \quad \alpha = 299.94274^\circ, \quad \beta = 59.94267^\circ, \quad V = 2.50087\,mgl}"
        => r"\fixed{\theta = 73.92059^\circ, \quad \alpha = 321.40086^\circ, \quad \beta = 340.30513^\circ, \quad V = 3.66453\,mgl}";
}
